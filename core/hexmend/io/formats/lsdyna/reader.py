"""Reader of LS-DYNA's keyword files.

Coordinates of an LS-DYNA deck in the columns of *NODE, also of files that it includes.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.formats.decks.lines import CardLines
from hexmend.io.formats.decks.model import DeckModel, solids_by_width
from hexmend.io.formats.lsdyna.deck import join, keywords
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

#: Columns of a node (id and coordinates), of an element (id, part and nodes) and of a member of a set.
NODE_COLUMNS = (8, 16, 16, 16)
ELEMENT_COLUMNS, SET_COLUMNS = (8,) * 10, (10,) * 8
#: Elements with their part in the second field: solids, and kinds by their number of different nodes.
_SOLIDS = {"ELEMENT_SOLID", "ELEMENT_TSHELL"}
_LOWER = {"ELEMENT_SHELL": {3: "triangle", 4: "quad"}, "ELEMENT_BEAM": {2: "line"}}
#: Lines of each element besides its own, by what follows the name of its keyword.
_MORE_LINES = {"": 0, "_ORTHO": 2, "_THICKNESS": 1, "_BETA": 1, "_THICKNESS_BETA": 1, "_OFFSET": 1, "_ORIENTATION": 1}
#: Field of the first node of elements that are not read, whose nodes stay.
_HOLDING = {"ELEMENT_DISCRETE": 2, "ELEMENT_MASS": 1, "ELEMENT_SEATBELT": 2, "ELEMENT_INERTIA": 1}
#: Sets of a model by the names of their keywords.
_SETS = {"NODE": "nodes", "SOLID": "solids", "SEGMENT": "faces"}
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
    reader = _Reader(DeckModel(path, "*NODE", "a keyword file of LS-DYNA"))
    for keyword in keywords(join(path)):
        reader.read(keyword)
    return mesh_of(path, reader.model.content())


def locate(path: Path) -> DeckCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    return DeckCoordinates.of_lines([one for one in keywords(join(path)) if one.name == "*NODE"], NODE_COLUMNS, 1)


@dataclass
class _Reader:
    """Reader of one keyword after another, what it defines added to a model."""

    model: DeckModel

    def read(self, keyword: CardLines) -> None:
        """Add what a keyword defines."""
        name = keyword.name[1:]
        base = next((one for one in (*_SOLIDS, *_LOWER) if name == one or name.startswith(f"{one}_")), "")
        if name == "NODE":
            cards = keyword.cards(NODE_COLUMNS)
            self.model.nodes.append((cards.integers(0, 1)[:, 0], cards.reals(1, 4)))
        elif base:
            self._read_elements(keyword, base, name.removeprefix(base))
        elif name == "PART":  # each has a line with its title, and one with its number
            numbers = keyword.rows(slice(1, None, 2)).cards(SET_COLUMNS).integers(0, 1)[:, 0].tolist()
            self.model.part_names.update(zip(numbers, keyword.texts()[::2], strict=False))
        elif name.startswith(tuple(f"SET_{one}" for one in _SETS)):
            self._read_set(keyword)
        elif name not in _IGNORED:
            self.model.others[keyword.name] += 1
            if name.startswith(("CONTACT", "CONSTRAINED")):
                self.model.joining.append(keyword.name)
            first = next((field for one, field in _HOLDING.items() if name.startswith(one)), None)
            if first is not None:
                nodes = keyword.cards(ELEMENT_COLUMNS).integers(first, first + 1 + (first == 2))
                self.model.fixed[keyword.name].append(nodes.ravel())

    def _read_elements(self, keyword: CardLines, base: str, option: str) -> None:
        if option not in _MORE_LINES:
            if base in _SOLIDS:
                raise keyword.error("is a form of solids that is not read", "Write them as *ELEMENT_SOLID.")
            self.model.others[keyword.name] += len(keyword.begin)
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
        kinds = {8: "hex", 10: "tetra10"}
        if base not in _SOLIDS:
            kinds, nodes = _LOWER[base], nodes[:, : max(_LOWER[base])].copy()
            nodes[nodes[:, -1] == nodes[:, -2], -1] = 0  # a triangle may repeat its last node
        n_left = len(rows)
        for kind, which, own in solids_by_width(nodes, kinds):
            n_left -= len(which)
            self.model.add_elements(kind, keyword.begin[which * step], *rows[which, :2].T, own)
        if n_left > 0:
            self.model.others[f"elements of {keyword.name} with other numbers of nodes"] += n_left

    def _read_set(self, keyword: CardLines) -> None:
        """Read a set: a title where its name ends in TITLE, its number, and its members."""
        kind, *options = keyword.name.removeprefix("*SET_").split("_")
        first = int("TITLE" in options)
        if len(keyword.begin) <= first or set(options) - {"LIST", "TITLE", "GENERATE"}:
            self.model.others[keyword.name] += 1
            return
        number = keyword.rows(slice(first, first + 1)).cards(SET_COLUMNS).integers(0, 1)[0, 0]
        title = keyword.texts()[0] if first else ""
        members = keyword.rows(slice(first + 1, None)).cards(SET_COLUMNS).integers(0, 4 if kind == "SEGMENT" else 8)
        if kind != "SEGMENT":
            members = members[members != 0]
        if "GENERATE" in options:
            members = members[: len(members) // 2 * 2].reshape(-1, 2)
        self.model.add_set(_SETS[kind], title or f"{kind.lower()} set {number}", members)
