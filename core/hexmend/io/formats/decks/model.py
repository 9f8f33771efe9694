"""Nodes, elements and sets of a deck by its own numbers, which become a mesh once everything is read."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, dimension
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import find_ids, lookup
from hexmend.io.base.remedies import check_suffix, some_names, unread_note
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.terminal_text import count_phrase


class DeckModel:
    """Nodes, elements and sets that the cards of a deck have defined so far.

    Parameters
    ----------
    path : Path
    node_card : str
        Name of the cards of nodes, for errors.
    title : str
        What the file should be, for errors, such as "a keyword file of LS-DYNA".

    Attributes
    ----------
    nodes : list of ((k,) int64, (k, 3) float64)
        Numbers and coordinates.
    part_names : dict of int to str
        Titles of parts by their numbers.
    sets : dict of str to dict of str to list of arrays
        Members of each set of "nodes", "elements", "solids" and "faces" by its name: numbers (k,), first and last
        ones (k, 2), or nodes of faces (k, 4).
    fixed : dict of str to list of (k,) int64
        Numbers of nodes that stay, by the cards that fix them and are not read.
    others : Counter
        Cards that are not read.
    joining : list of str
        Names of cards by which bodies touch or are joined.
    notes : list of str
        Other notes for the mesh.
    """

    def __init__(self, path: Path, node_card: str, title: str):
        self.path, self._node_card, self._title = path, node_card, title
        self.nodes: list[tuple[np.ndarray, np.ndarray]] = []
        self.part_names: dict[int, str] = {}
        self.sets: defaultdict[str, dict[str, list[np.ndarray]]] = defaultdict(dict)
        self.fixed: defaultdict[str, list[np.ndarray]] = defaultdict(list)
        self.others: Counter[str] = Counter()
        self.joining: list[str] = []
        self.notes: list[str] = []
        self._elements: dict[str, list[np.ndarray]] = {}  # by kind; a row is a place, an id, a part and nodes

    def add_elements(
        self, kind: str, places: np.ndarray, ids: np.ndarray, parts: np.ndarray | int, nodes: np.ndarray
    ) -> None:
        """Add elements of a kind.

        Parameters
        ----------
        kind : str
        places : (k,) int64
            By which the elements of the file are ordered, such as lines.
        ids, parts : (k,) int64
            Their numbers and those of their parts; 0 for none.
        nodes : (k, width) int64
            Numbers of nodes in VTK's order.
        """
        if len(ids):
            rows = np.column_stack([places, ids, np.broadcast_to(parts, ids.shape), nodes]).astype(np.int64, copy=False)
            self._elements.setdefault(kind, []).append(rows)

    def add_set(self, kind: str, name: str, members: np.ndarray) -> None:
        """Add members to a set of "nodes", "elements", "solids" or "faces"; see `sets`."""
        self.sets[kind].setdefault(name, []).append(members)

    def given_nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the numbers (n,) and coordinates (n, 3) of all nodes; raises `FileError` where there are none."""
        if not self.nodes:
            raise FileError(self.path, f"has no {self._node_card}", check_suffix(self._title))
        ids, points = map(np.concatenate, zip(*self.nodes, strict=True))
        return ids, points

    def blocks(self, node_ids: np.ndarray, name_of_part: Callable[[int], str] | None = None) -> list[Block]:
        """Return a block for each kind of elements, hexes first, with the sets of elements.

        Parameters
        ----------
        node_ids : (n,) int64
        name_of_part : callable, optional
            name_of_part(number) names the set of a part; its title, or "part N" where there are several.
        """
        numbers = {one for parts in self._elements.values() for rows in parts for one in np.unique(rows[:, 2]).tolist()}
        name_of_part = name_of_part or (self._part_name if len(numbers) > 1 else lambda number: "")
        blocks = []
        for kind in sorted(self._elements, key=lambda kind: (kind not in HEX_KINDS, HEX_KINDS.get(kind, 0))):
            rows = np.concatenate(self._elements[kind])
            _, ids, parts, *_ = (rows := rows[np.argsort(rows[:, 0], kind="stable")]).T
            sets = {
                name: np.flatnonzero(parts == one) for one in np.unique(parts).tolist() if (name := name_of_part(one))
            }
            blocks.append(Block(kind, find_ids(self.path, node_ids, rows[:, 3:], "node"), {ID: ids.copy()}, sets))
            kinds = ("elements", "solids") if dimension(kind) == 3 else ("elements",)
            for name, members in (item for one in kinds for item in self.sets[one].items()):
                if (own := _members(ids, members)).size:
                    sets[name] = own
        return blocks

    def content(self, name_of_part: Callable[[int], str] | None = None) -> Content:
        """Return the content that all cards make together; `name_of_part` is as of `blocks`."""
        node_ids, points = self.given_nodes()
        blocks = self.blocks(node_ids, name_of_part)
        node_sets = {name: _members(node_ids, parts) for name, parts in self.sets["nodes"].items()}
        hexes = [block.nodes[:, :8] for block in blocks if block.kind in HEX_KINDS]
        sides = {name: _sides(hexes, node_ids, parts) for name, parts in self.sets["faces"].items() if hexes}
        sides = {name: rows for name, rows in sides.items() if len(rows)}
        lists = [ids for each in self.fixed.values() for ids in each]
        fixed = np.isin(node_ids, np.concatenate([*lists, np.zeros(0, np.int64)]))
        notes = list(self.notes)
        if self.others:
            words = some_names(f"{count:,} {quoted(name)[1:-1]}" for name, count in self.others.items())
            notes.append(unread_note(f"other cards ({words})"))
        if fixed.any():
            nodes = count_phrase(int(fixed.sum()), "node")
            notes.append(f"{nodes} of {some_names(quoted(one)[1:-1] for one in self.fixed)} stay.")
        fields, pinned = {CONTACT_CARDS: self.joining} if self.joining else {}, fixed if fixed.any() else None
        return Content(points, tuple(blocks), {ID: node_ids}, node_sets, sides, pinned, fields, tuple(notes))

    def _part_name(self, number: int) -> str:
        """Name of the set of a part: its title where no other part has it."""
        title = self.part_names.get(number, "")
        return title if title and list(self.part_names.values()).count(title) == 1 else f"part {number}"


def _members(ids: np.ndarray, parts: list[np.ndarray]) -> np.ndarray:
    """Indices of members, ascending: of numbers (k,) and ranges (k, 2); those that do not exist are left out."""
    chosen = np.zeros(len(ids), dtype=bool)
    for part in parts:
        if part.ndim == 1:
            chosen |= np.isin(ids, part)
        for low, high in part.tolist() if part.ndim == 2 else ():
            chosen |= (ids >= low) & (ids <= high)
    return np.flatnonzero(chosen)


def _sides(hexes: list[np.ndarray], node_ids: np.ndarray, parts: list[np.ndarray]) -> np.ndarray:
    """Faces of hexes, (k, 2) int64, that have the four nodes of faces given by numbers."""
    wanted, there = lookup(node_ids, np.concatenate(parts))
    weights = np.random.default_rng(0).integers(1, 2**62, len(node_ids))  # whose sum tells the nodes of a face
    faces = weights[np.concatenate(hexes)[:, FACES]].sum(axis=2)  # overflow does no harm
    return np.argwhere(np.isin(faces, weights[wanted].sum(axis=1)[there.all(axis=1)])).astype(np.int64)


def solids_by_width(nodes: np.ndarray, kinds: dict[int, str]) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Yield the kinds of elements by the number of their nodes, the rows (k,) of each, and their nodes.

    Parameters
    ----------
    nodes : (k, width) int64
        0 behind the last node of an element.
    kinds : dict of int to str
        Kind of cell by number of nodes.
    """
    counts = (nodes != 0).sum(axis=1)
    for count, kind in kinds.items():
        rows = np.flatnonzero(counts == count)
        yield kind, rows, nodes[rows, :count]
