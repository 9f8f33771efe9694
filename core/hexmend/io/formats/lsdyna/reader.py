"""Reader of LS-DYNA's keyword files.

Coordinates of an LS-DYNA deck in the columns of *NODE, also of files that it includes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, node_count
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import find_ids, lookup
from hexmend.io.base.remedies import DAMAGED, check_suffix, some_names, unread_note
from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.coordinates.text_coordinates import Edits, shortened
from hexmend.io.formats.lsdyna.deck import Keyword, join, keywords
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.mesh.collapsed_hexes import collapsed_solids
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

#: Columns of a node (id and coordinates), of an element (id, part and nodes) and of a member of a set.
NODE_COLUMNS = (8, 16, 16, 16)
ELEMENT_COLUMNS, SET_COLUMNS = (8,) * 10, (10,) * 8
#: Elements with their part in the second field: solids, and kinds by their number of different nodes.
_SOLIDS = {"ELEMENT_SOLID", "ELEMENT_TSHELL"}
_LOWER = {"ELEMENT_SHELL": {3: "triangle", 4: "quad"}, "ELEMENT_BEAM": {2: "line", 3: "line"}}
#: Lines of each element besides its own, by what follows the name of its keyword.
_MORE_LINES = {"": 0, "_ORTHO": 2, "_THICKNESS": 1, "_BETA": 1, "_THICKNESS_BETA": 1, "_OFFSET": 1, "_ORIENTATION": 1}
#: Field of the first node of elements that are not read, whose nodes stay.
_HOLDING = {"ELEMENT_DISCRETE": 2, "ELEMENT_MASS": 1, "ELEMENT_SEATBELT": 2, "ELEMENT_INERTIA": 1}
#: Keywords that no note mentions.
_IGNORED = ("KEYWORD", "TITLE")


def read(path: Path) -> Mesh:
    """Read nodes, elements, parts and sets of a keyword file; the elements of part N become the set "part N".

    Parameters
    ----------
    path : Path

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For a malformed line, an included file that does not exist, and solids of forms that are not read.
    MeshError
        From `Mesh`.
    """
    model = _Model()
    for keyword in keywords(join(path)):
        model.add(keyword)
    return mesh_of(path, model.content(path))


class _Model:
    """Nodes, elements and sets of the keywords read so far."""

    def __init__(self) -> None:
        self.nodes: list[tuple[np.ndarray, np.ndarray]] = []
        self.elements: dict[str, list[np.ndarray]] = {}  # by kind; a row is an id, a part and nodes
        self.names: dict[int, str] = {}  # of parts
        self.sets: dict[str, dict[str, list[np.ndarray]]] = {"NODE": {}, "SOLID": {}, "SEGMENT": {}}
        self.connected: list[np.ndarray] = []
        self.others: Counter[str] = Counter()

    def add(self, keyword: Keyword) -> None:
        """Add what a keyword defines."""
        name = keyword.name
        base = next((one for one in (*_SOLIDS, *_LOWER) if name == one or name.startswith(f"{one}_")), "")
        if name == "NODE":
            cards = keyword.cards(NODE_COLUMNS)
            self.nodes.append((cards.integers(0, 1)[:, 0], cards.reals(1, 4)))
        elif base:
            self._add_elements(keyword, base, name.removeprefix(base))
        elif name == "PART":
            self._add_parts(keyword)
        elif name.startswith(("SET_NODE", "SET_SOLID", "SET_SEGMENT")):
            self._add_set(keyword)
        elif name not in _IGNORED:
            self.others[f"*{name}"] += 1
            first = next((field for one, field in _HOLDING.items() if name.startswith(one)), None)
            if first is not None:
                self.connected.append(keyword.cards(ELEMENT_COLUMNS).integers(first, first + 1 + (first == 2)).ravel())

    def _add_elements(self, keyword: Keyword, base: str, option: str) -> None:
        if option not in _MORE_LINES:
            if base in _SOLIDS:
                raise keyword.error("is a form of solids that is not read", "Write them as *ELEMENT_SOLID.")
            self.others[f"*{keyword.name}"] += len(keyword.begin)
            return
        width = len(ELEMENT_COLUMNS)
        head = keyword.rows(slice(1)).cards(ELEMENT_COLUMNS)
        is_long = base in _SOLIDS and len(head.lines) > 0 and (head.fields(2, width) == b"").all()
        step = 1 + is_long + _MORE_LINES[option]
        if len(keyword.begin) % step:
            problem = f"has {count_phrase(len(keyword.begin), 'line')}: expected {step} an element"
            raise keyword.error(problem, DAMAGED)
        rows = keyword.rows(slice(None, None, step)).cards(ELEMENT_COLUMNS).integers(0, width)
        nodes = rows[:, 2:]
        if is_long:  # they are in the second line
            nodes = keyword.rows(slice(1, None, step)).cards(ELEMENT_COLUMNS).integers(0, width)
        wrong = np.flatnonzero((nodes[:, :8] == 0).any(axis=1))
        if base in _SOLIDS and wrong.size:
            place = keyword.files.place(int(keyword.begin[wrong[0] * step]))
            problem = f"has {np.count_nonzero(nodes[wrong[0], :8])} nodes in {place}: expected 8"
            raise keyword.error(problem, DAMAGED)
        kinds = _solids(nodes) if base in _SOLIDS else _lower(nodes[:, : 4 if base == "ELEMENT_SHELL" else 2], base)
        n_left = len(rows)
        for kind, which, own in kinds:
            n_left -= len(which)
            if len(which):
                self.elements.setdefault(kind, []).append(np.column_stack([rows[which, :2], own]))
        if n_left > 0:
            self.others[f"elements of *{keyword.name} with other numbers of nodes"] += n_left

    def _add_parts(self, keyword: Keyword) -> None:
        """Add the titles of parts; each has a line with it, and one with its number."""
        numbers = keyword.rows(slice(1, None, 2)).cards(SET_COLUMNS).integers(0, 1)[:, 0].tolist()
        self.names.update(zip(numbers, keyword.texts()[::2], strict=False))

    def _add_set(self, keyword: Keyword) -> None:
        """Add a set: a title where its name ends in TITLE, its number, and its members."""
        kind, *options = keyword.name.removeprefix("SET_").split("_")
        first = int("TITLE" in options)
        if len(keyword.begin) <= first or set(options) - {"LIST", "TITLE", "GENERATE"}:
            self.others[f"*{keyword.name}"] += 1
            return
        number = keyword.rows(slice(first, first + 1)).cards(SET_COLUMNS).integers(0, 1)[0, 0]
        title = keyword.texts()[0] if first else ""
        body = keyword.rows(slice(first + 1, None)).cards(SET_COLUMNS)
        members = body.integers(0, 4 if kind == "SEGMENT" else 8)
        if kind != "SEGMENT":
            members = members[members != 0]
        if "GENERATE" in options:
            ranges = members[: len(members) // 2 * 2].reshape(-1, 2).tolist()
            members = np.array([[low, high] for low, high in ranges], np.int64).reshape(-1, 2)
        label = title or f"{kind.lower()} set {number}"
        self.sets[kind].setdefault(label, []).append(members)

    def content(self, path: Path) -> Content:
        """Return the content that all keywords make together."""
        if not self.nodes:
            raise FileError(path, "has no *NODE", check_suffix("a keyword file of LS-DYNA"))
        node_ids, points = map(np.concatenate, zip(*self.nodes, strict=True))
        blocks: list[Block] = []
        n_parts = len({one for parts in self.elements.values() for rows in parts for one in rows[:, 1].tolist()})
        for kind, parts in self.elements.items():
            rows = np.concatenate(parts)
            own = np.unique(rows[:, 1]).tolist() if n_parts > 1 else []
            sets = {self._part(one): np.flatnonzero(rows[:, 1] == one) for one in own}
            nodes = find_ids(path, node_ids, rows[:, 2:], "node")
            blocks.append(Block(kind, nodes, {ID: rows[:, 0].copy()}, sets))
        blocks.sort(key=lambda block: block.kind not in HEX_KINDS)
        self._add_solid_sets(blocks)
        node_sets = {name: _members(node_ids, parts) for name, parts in self.sets["NODE"].items()}
        hexes = [block.nodes for block in blocks if block.kind == "hex"]
        sides = {name: _sides(hexes[0], node_ids, parts) for name, parts in self.sets["SEGMENT"].items() if hexes}
        sides = {name: rows for name, rows in sides.items() if len(rows)}
        fixed = np.isin(node_ids, np.concatenate([*self.connected, np.zeros(0, np.int64)]))
        notes = []
        if self.others:
            notes.append(unread_note(f"other keywords ({some_names(quoted(one)[1:-1] for one in self.others)})"))
        if fixed.any():
            notes.append(f"{count_phrase(int(fixed.sum()), 'node')} of springs, masses and belts stay.")
        joining = [one for one in self.others if one.startswith(("*CONTACT", "*CONSTRAINED"))]
        fields, pinned = {CONTACT_CARDS: joining} if joining else {}, fixed if fixed.any() else None
        return Content(points, tuple(blocks), {ID: node_ids}, node_sets, sides, pinned, fields, tuple(notes))

    def _part(self, number: int) -> str:
        """Name of the set of a part: its title where no other part has it."""
        title = self.names.get(number, "")
        return title if title and list(self.names.values()).count(title) == 1 else f"part {number}"

    def _add_solid_sets(self, blocks: list[Block]) -> None:
        for name, parts in self.sets["SOLID"].items():
            for block in blocks:
                own = _members(block.data[ID], parts)
                if own.size and node_count(block.kind) >= 4 and block.kind != "quad":
                    block.sets[name] = own


def _solids(nodes: np.ndarray) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Yield the kinds of solids, the rows (k,) of each, and their nodes; those of other kinds are collapsed hexes."""
    ends = (nodes[:, 8:] > 0).all(axis=1) & (nodes.shape[1] > 8)
    yield "tetra10", np.flatnonzero(ends), nodes[ends, :10]
    others, is_hex = np.flatnonzero(~ends), ~ends
    for kind, rows, own in collapsed_solids(nodes[others, :8]):
        is_hex[others[rows]] = False
        yield kind, others[rows], own
    yield "hex", np.flatnonzero(is_hex), nodes[is_hex, :8]


def _lower(nodes: np.ndarray, base: str) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Yield the kinds of shells or beams, the rows (k,) of each, and their nodes; a triangle may repeat its last."""
    if base == "ELEMENT_BEAM":
        rows = np.flatnonzero(nodes.all(axis=1))
        yield "line", rows, nodes[rows]
        return
    triangle = (nodes[:, 3] == 0) | (nodes[:, 3] == nodes[:, 2])
    yield "triangle", np.flatnonzero(triangle), nodes[triangle, :3]
    yield "quad", np.flatnonzero(~triangle), nodes[~triangle]


def _members(ids: np.ndarray, parts: list[np.ndarray]) -> np.ndarray:
    """Indices of members, ascending: of numbers (k,) and ranges (k, 2); those that do not exist are left out."""
    chosen = np.zeros(len(ids), dtype=bool)
    for part in parts:
        if part.ndim == 1:
            chosen |= np.isin(ids, part)
        for low, high in part.tolist() if part.ndim == 2 else ():
            chosen |= (ids >= low) & (ids <= high)
    return np.flatnonzero(chosen)


def _sides(hexes: np.ndarray, node_ids: np.ndarray, parts: list[np.ndarray]) -> np.ndarray:
    """Faces of hexes, (k, 2) int64, that have the nodes of segments."""
    segments, there = lookup(node_ids, np.concatenate(parts))
    weights = np.random.default_rng(0).integers(1, 2**62, len(node_ids))  # whose sum tells the nodes of a face
    faces = weights[hexes[:, FACES]].sum(axis=2)  # overflow does no harm
    wanted = weights[segments].sum(axis=1)[there.all(axis=1)]
    return np.argwhere(np.isin(faces, wanted)).astype(np.int64)


_DIGITS = "Fields of 16 columns hold 9 to 14 digits of the new coordinates."


def locate(path: Path) -> DynaCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    files = join(path)
    nodes = [keyword for keyword in keywords(files) if keyword.name == "NODE"]
    return DynaCoordinates(files, nodes, np.concatenate([one.cards(NODE_COLUMNS).reals(1, 4) for one in nodes]))


@dataclass(frozen=True, eq=False)
class DynaCoordinates:
    """Coordinates of all nodes, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : JoinedFiles
    nodes : list of Keyword
        Those named *NODE.
    points : (n, 3) float64
    """

    files: JoinedFiles
    nodes: list[Keyword]
    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the deck and its files with new coordinates; see `LocatedCoordinates.write`."""
        rows: list[tuple[int, int, bytes]] = []
        first, exact = 0, True
        for keyword in self.nodes:
            begin, end, free = keyword.ranges(NODE_COLUMNS)
            own = slice(first, first + len(begin))
            first = own.stop
            for node, axis in np.argwhere(~(points[own] == self.points[own])).tolist():
                value, low, high = float(points[own][node, axis]), int(begin[node, axis + 1]), int(end[node, axis + 1])
                width = 0 if free[node] else (20 if keyword.is_long else 16)
                text = repr(value) if len(repr(value)) < (width or 21) else shortened(value, (width or 21) - 1)
                exact = exact and float(text) == value
                rows.append((low, high, text.rjust(width).encode()))
        notes = self.files.write(files, target, Edits.of(rows))
        return notes if exact else (*notes, _DIGITS)
