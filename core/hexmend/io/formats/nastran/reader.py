"""Reader of Nastran's bulk data: regular cards in blocks, all others one by one."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, to_vtk_order
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.base.numbering import find_ids
from hexmend.io.base.remedies import DAMAGED, check_suffix, some_names, unread_note
from hexmend.io.formats.nastran.bulk import BulkData, CardBlock, natural_numbers
from hexmend.io.formats.nastran.cards import KINDS_OF_CARD, ORDER, element_layout
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read grid points and elements; the elements of property N become the set "property N".

    Parameters
    ----------
    path : Path

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For a card that is malformed, a coordinate system other than the basic one, or INCLUDE.
    MeshError
        From `Mesh`.
    """
    bulk = BulkData(path, read_text_bytes(path).replace(b"\r\n", b"\n").replace(b"\r", b"\n"))
    model = BulkModel(bulk)
    for item in bulk.cards_and_blocks({"GRID", *KINDS_OF_CARD}):
        if not isinstance(item, CardBlock):
            model.add_card(*item)
        elif not model.add_block(item):  # read card by card, which also finds the line of an error
            for card in bulk.cards(item.first, item.last):
                model.add_card(*card)
    return mesh_of(path, model.content())


class _RowBuffer:
    """Rows of numbers, appended one by one or in arrays."""

    def __init__(self, dtype: type):
        self._dtype, self._arrays, self._single = dtype, [], []

    def append(self, row: object) -> None:
        """Append a number or a list of numbers."""
        self._single.append(row)

    def extend(self, rows: np.ndarray) -> None:
        """Append an array of rows."""
        self._flush()
        self._arrays.append(rows)

    def array(self) -> np.ndarray:
        """Return all rows in one array."""
        self._flush()
        return np.concatenate(self._arrays) if self._arrays else np.empty(0, self._dtype)

    def _flush(self) -> None:
        if self._single:
            self._arrays.append(np.array(self._single, self._dtype))
            self._single = []


class BulkModel:
    """Grid points and elements of the cards read so far."""

    def __init__(self, bulk: BulkData):
        self.bulk = bulk
        self.node_ids, self.points = _RowBuffer(np.int64), _RowBuffer(np.float64)
        self.elements: dict[str, _RowBuffer] = {}  # by kind; a row is an id, a property and nodes
        self.other_cards: dict[str, int] = {}
        self.n_partial = 0  # elements with some of their mid-nodes only

    def add_card(self, line: int, name: str, fields: list[str]) -> None:
        """Add one card."""
        bulk = self.bulk
        if name in ("GRID", "GRDSET"):
            if bulk.integer(fields[1], line, name):
                problem = f"{name} in line {line} is in the coordinate system {fields[1]}: expected 0, x, y and z"
                raise bulk.error(problem, "Write the file with all grid points in the basic coordinate system.")
            if name == "GRID":
                self.node_ids.append(bulk.integer(fields[0], line, name))
                self.points.append([bulk.real(word, line, name) for word in [*fields, ""][2:5]])
        elif name in KINDS_OF_CARD:
            self._add_element(line, name, fields)
        elif name.startswith("INCLUDE"):
            raise bulk.error(f"INCLUDE in line {line} reads cards from another file", "Insert its content there.")
        elif name != "ENDDATA":
            self.other_cards[name] = self.other_cards.get(name, 0) + 1

    def add_block(self, block: CardBlock) -> bool:
        """Add a block of cards; return False, and add none, where one of them is irregular."""
        return self._add_grid_points(block) if block.name == "GRID" else self._add_elements(block)

    def _add_grid_points(self, block: CardBlock) -> bool:
        numbers = natural_numbers(block.fields[:, :2])
        if numbers is None or numbers[:, 1].any() or block.fields.shape[1] < 5:
            return False
        try:
            points = self._reals(block.fields[:, 2:5])
        except FileError:
            return False
        self.node_ids.extend(numbers[:, 0])
        self.points.extend(points)
        return True

    def _add_elements(self, block: CardBlock) -> bool:
        first, linear, quadratic, n_corners, n_nodes = element_layout(block.name)
        numbers = natural_numbers(block.fields[:, : first + n_nodes])
        if numbers is None or numbers.shape[1] < first + n_corners or not numbers[:, first : first + n_corners].all():
            return False
        count = len(numbers)
        head = np.column_stack([numbers[:, 0], numbers[:, 1] if first == 2 else np.zeros(count, np.int64)])
        nodes = numbers[:, first:]
        n_mid = (nodes[:, n_corners:] != 0).sum(axis=1)
        full = (n_mid == n_nodes - n_corners) if quadratic else np.zeros(count, bool)
        for kind, chosen, nodes_of in ((linear, ~full, nodes[:, :n_corners]), (quadratic, full, nodes)):
            if chosen.any():
                self._rows(kind).extend(np.column_stack([head, nodes_of])[chosen])
        self.n_partial += int(((n_mid > 0) & ~full).sum())
        return True

    def _reals(self, fields: np.ndarray) -> np.ndarray:
        try:
            return fields.astype(np.float64)
        except ValueError:  # blanks, and exponents without their letter
            rows = np.char.strip(fields).astype(str).tolist()
            return np.array([[self.bulk.real(word, 0, "GRID") for word in row] for row in rows])

    def _add_element(self, line: int, name: str, fields: list[str]) -> None:
        bulk = self.bulk
        first, linear, quadratic, n_corners, n_nodes = element_layout(name)
        property_id = bulk.integer(fields[1], line, name) if first == 2 else 0
        nodes = [bulk.integer(word, line, name) for word in fields[first : first + n_nodes]]
        if len(nodes) < n_corners or 0 in nodes[:n_corners]:
            found = sum(map(bool, nodes[:n_corners]))
            raise bulk.error(f"{name} in line {line} has {found} nodes: expected {n_corners}", DAMAGED)
        n_mid = sum(map(bool, nodes[n_corners:]))
        full = bool(quadratic) and n_mid == n_nodes - n_corners
        element_id = bulk.integer(fields[0], line, name)
        row = [element_id, property_id, *nodes[: n_nodes if full else n_corners]]
        self._rows(quadratic if full else linear).append(row)
        self.n_partial += bool(n_mid) and not full

    def _rows(self, kind: str) -> _RowBuffer:
        return self.elements.setdefault(kind, _RowBuffer(np.int64))

    def content(self) -> Content:
        """Return the content that all cards make together."""
        node_ids, notes = self.node_ids.array(), []
        if not len(node_ids):
            raise self.bulk.error("has no GRID", check_suffix("a Nastran bulk data file"))
        if self.n_partial:
            partial = f"{self.n_partial:,} elements have some of their mid-nodes only"
            notes.append(f"{partial}: they are read with their corners only.")
        if self.other_cards:
            words = some_names(f"{count:,} {quoted(name)[1:-1]}" for name, count in self.other_cards.items())
            notes.append(unread_note(f"other cards ({words})"))
        blocks = [_block(self.bulk.path, kind, rows.array(), node_ids) for kind, rows in self.elements.items()]
        blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
        return Content(self.points.array(), tuple(blocks), {ID: node_ids}, notes=tuple(notes))


def _block(path: Path, kind: str, rows: np.ndarray, node_ids: np.ndarray) -> Block:
    """Block of the elements of a kind, of rows of an id, a property and nodes."""
    nodes = find_ids(path, node_ids, rows[:, 2:], "node")
    numbers = np.unique(rows[:, 1]).tolist()
    sets = {f"property {number}": np.flatnonzero(rows[:, 1] == number) for number in numbers if number > 0}
    return Block(kind, to_vtk_order(nodes, kind, ORDER), {ID: rows[:, 0].copy()}, sets)
