"""Reads Nastran's bulk data: long stretches of cards at a time, and the others card by card."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.base.numbering import find_ids
from hexmend.io.formats.nastran import ORDER
from hexmend.io.formats.nastran.bulk import Bulk
from hexmend.io.formats.nastran.card_blocks import Stretch, wholes
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh

#: What the elements of a name are, of first and second order.
KINDS = {
    "CHEXA": ("hex", "hex20"), "CTETRA": ("tetra", "tetra10"), "CPENTA": ("wedge", "wedge15"),
    "CPYRAM": ("pyramid", "pyramid13"), "CPYRA": ("pyramid", "pyramid13"), "CQUAD4": ("quad", ""),
    "CQUADR": ("quad", ""), "CSHEAR": ("quad", ""), "CQUAD8": ("quad", "quad8"), "CQUAD": ("quad", "quad9"),
    "CTRIA3": ("triangle", ""), "CTRIAR": ("triangle", ""), "CTRIA6": ("triangle", "triangle6"),
    "CBAR": ("line", ""), "CBEAM": ("line", ""), "CROD": ("line", ""), "CTUBE": ("line", ""), "PLOTEL": ("line", ""),
}  # fmt: skip


def read(path: Path) -> Mesh:
    """Read grid points and elements; the elements of a property are the set "property N"."""
    bulk = Bulk(path, read_text_bytes(path).replace(b"\r\n", b"\n").replace(b"\r", b"\n"))
    reader = _Reader(bulk)
    for piece in bulk.pieces({"GRID", *KINDS}):
        if not isinstance(piece, Stretch):
            reader.card(*piece)
        elif not reader.stretch(piece):  # something in it is not as usual: it is read, or told, card by card
            for card in bulk.cards(piece.first, piece.last):
                reader.card(*card)
    return mesh_of(path, reader.content())


class _Rows:
    """Rows of numbers, to which come single ones and many at a time."""

    def __init__(self, dtype: type):
        self._dtype, self._parts, self._single = dtype, [], []

    def add(self, row: object) -> None:
        """One more, a number or a list of them."""
        self._single.append(row)

    def extend(self, rows: np.ndarray) -> None:
        """Many more."""
        self._parts += [self._of_single(), rows] if self._single else [rows]
        self._single = []

    def whole(self) -> np.ndarray:
        """All of them in one array."""
        parts = [*self._parts, self._of_single()] if self._single else self._parts
        return np.concatenate(parts) if parts else np.empty(0, self._dtype)

    def _of_single(self) -> np.ndarray:
        return np.array(self._single, self._dtype)


class _Reader:
    """Gathers what the cards say."""

    def __init__(self, bulk: Bulk):
        self.bulk = bulk
        self.ids, self.points = _Rows(np.int64), _Rows(np.float64)
        self.rows: dict[str, _Rows] = {}  # of each kind the number, property and nodes of its elements
        self.other: dict[str, int] = {}
        self.partial = 0

    def card(self, line: int, name: str, fields: list[str]) -> None:
        """Take one card."""
        bulk = self.bulk
        if name in ("GRID", "GRDSET"):
            if bulk.whole(fields[1], line, name):
                raise bulk.error(
                    f"{name} in line {line} is in the coordinate system {fields[1]}: expected 0, x, y and z",
                    "Write the file with all grid points in the basic coordinate system.",
                )
            if name == "GRID":
                self.ids.add(bulk.whole(fields[0], line, name))
                self.points.add([bulk.real(word, line, name) for word in [*fields, ""][2:5]])
        elif name in KINDS:
            self._element(line, name, fields)
        elif name.startswith("INCLUDE"):
            raise bulk.error(f"INCLUDE in line {line} takes what follows from another file", "Put its content there.")
        elif name != "ENDDATA":
            self.other[name] = self.other.get(name, 0) + 1

    def stretch(self, cards: Stretch) -> bool:
        """Take many cards of one name; False, and none is taken, where any of them is not as it should be."""
        if cards.name == "GRID":
            numbers = wholes(cards.words[:, :2])
            if numbers is None or numbers[:, 1].any() or cards.words.shape[1] < 5:
                return False
            try:
                points = self._reals(cards.words[:, 2:5])
            except FileError:
                return False
            self.ids.extend(numbers[:, 0])
            self.points.extend(points)
            return True
        first, small, large, width, longest = _shape(cards.name)
        numbers = wholes(cards.words[:, : first + longest])
        if numbers is None or numbers.shape[1] < first + width or not numbers[:, first : first + width].all():
            return False
        head = np.column_stack([numbers[:, 0], numbers[:, 1] if first == 2 else np.zeros(len(numbers), np.int64)])
        nodes = numbers[:, first:]
        more = (nodes[:, width:] != 0).sum(axis=1)
        full = (more == longest - width) if large else np.zeros(len(numbers), bool)
        for kind, chosen, nodes_of in ((small, ~full, nodes[:, :width]), (large, full, nodes)):
            if chosen.any():
                rows = np.column_stack([head, nodes_of])[chosen]
                self.rows.setdefault(kind, _Rows(np.int64)).extend(rows)
        self.partial += int(((more > 0) & ~full).sum())
        return True

    def _reals(self, words: np.ndarray) -> np.ndarray:
        try:
            return words.astype(np.float64)
        except ValueError:  # blanks, and exponents without their letter
            rows = np.char.strip(words).astype(str).tolist()
            return np.array([[self.bulk.real(word, 0, "GRID") for word in row] for row in rows])

    def _element(self, line: int, name: str, fields: list[str]) -> None:
        bulk = self.bulk
        first, small, large, width, longest = _shape(name)
        property = bulk.whole(fields[1], line, name) if first == 2 else 0
        nodes = [bulk.whole(word, line, name) for word in fields[first : first + longest]]
        if len(nodes) < width or 0 in nodes[:width]:
            raise bulk.error(
                f"{name} in line {line} has {sum(map(bool, nodes[:width]))} nodes: expected {width}",
                "Write the file again with the program that made it: it is damaged or cut short.",
            )
        more = sum(map(bool, nodes[width:]))
        kind = large if large and more == longest - width else small
        row = [bulk.whole(fields[0], line, name), property, *nodes[: longest if kind == large else width]]
        self.rows.setdefault(kind, _Rows(np.int64)).add(row)
        self.partial += bool(more) and kind != large

    def content(self) -> Content:
        """What all cards together make."""
        tags, notes = self.ids.whole(), []
        if not len(tags):
            raise self.bulk.error("has no GRID", "Is it a file of Nastran's bulk data? Check its suffix.")
        if self.partial:
            notes.append(
                f"{self.partial:,} elements have some of their mid-nodes only: they are read with their corners."
            )
        if self.other:
            words = ", ".join(f"{count:,} {quoted(name)[1:-1]}" for name, count in list(self.other.items())[:6])
            notes.append(f"Other cards ({words}{', ...' if len(self.other) > 6 else ''}) are left out.")
        blocks = [_block(self.bulk.path, kind, rows.whole(), tags) for kind, rows in self.rows.items()]
        blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
        return Content(self.points.whole(), tuple(blocks), {ID: tags}, notes=tuple(notes))


def _shape(name: str) -> tuple[int, str, str, int, int]:
    """Where the nodes of an element of a name begin, the kinds that it is, and how many nodes these have."""
    small, large = KINDS[name]
    width = _width(small)
    return 1 if name == "PLOTEL" else 2, small, large, width, _width(large) if large else width


def _block(path: Path, kind: str, rows: np.ndarray, tags: np.ndarray) -> Block:
    nodes = find_ids(path, tags, rows[:, 2:], "node")
    numbers = np.unique(rows[:, 1]).tolist()
    sets = {f"property {number}": np.flatnonzero(rows[:, 1] == number) for number in numbers if number > 0}
    return Block(kind, nodes[:, ORDER[kind]] if kind in ORDER else nodes, {ID: rows[:, 0].copy()}, sets)


def _width(kind: str) -> int:
    return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes
