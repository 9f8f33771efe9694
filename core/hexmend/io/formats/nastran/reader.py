"""Reader of Nastran's bulk data."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, to_vtk_order
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.base.numbering import find_ids
from hexmend.io.base.remedies import DAMAGED, check_suffix, some_names, unread_note
from hexmend.io.formats.nastran.bulk import BulkData, Cards
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
    model = BulkModel(path)
    for cards in bulk.cards():
        model.add(cards)
    return mesh_of(path, model.content())


class BulkModel:
    """Grid points and elements of the cards read so far.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    """

    def __init__(self, path: Path):
        self._path = path
        self.grid_points: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []  # lines, ids, coordinates
        self._elements: dict[str, list[np.ndarray]] = {}  # by kind; a row is a line, an id, a property and nodes
        self._other_cards: dict[str, int] = {}
        self._n_partial = 0  # elements with some of their mid-nodes only

    def add(self, cards: Cards) -> None:
        """Add cards of one name."""
        if cards.name in ("GRID", "GRDSET"):
            self.add_grid_points(cards)
        elif cards.name in KINDS_OF_CARD:
            self._add_elements(cards)
        elif cards.name.startswith("INCLUDE"):
            raise cards.error(0, "reads cards from another file", "Insert its content there.")
        else:
            self._other_cards[cards.name] = self._other_cards.get(cards.name, 0) + len(cards.lines)

    def add_grid_points(self, cards: Cards) -> None:
        """Add the points of GRID; check the coordinate system of these, and that of GRDSET for those without one."""
        for at in np.flatnonzero(cards.integers(1, 2))[:1].tolist():
            problem = f"is in the coordinate system {cards.integers(1, 2)[at, 0]}: expected 0, x, y and z"
            raise cards.error(at, problem, "Write the file with all grid points in the basic coordinate system.")
        if cards.name == "GRID":
            self.grid_points.append((cards.lines, cards.integers(0, 1)[:, 0], cards.reals(2, 5)))

    def _add_elements(self, cards: Cards) -> None:
        first, linear, quadratic, n_corners, n_nodes = element_layout(cards.name)
        numbers = cards.integers(0, first + n_nodes)
        nodes = numbers[:, first:]
        for at in np.flatnonzero((nodes[:, :n_corners] == 0).any(axis=1))[:1].tolist():
            found = np.count_nonzero(nodes[at, :n_corners])
            raise cards.error(at, f"has {found} nodes: expected {n_corners}", DAMAGED)
        properties = numbers[:, 1] if first == 2 else np.zeros_like(cards.lines)
        rows = np.column_stack([cards.lines, numbers[:, 0], properties, nodes])
        n_mid = np.count_nonzero(nodes[:, n_corners:], axis=1)
        full = (n_mid == n_nodes - n_corners) & bool(quadratic)
        for kind, chosen, width in ((linear, ~full, 3 + n_corners), (quadratic, full, 3 + n_nodes)):
            if chosen.any():
                self._elements.setdefault(kind, []).append(rows[chosen, :width])
        self._n_partial += int(((n_mid > 0) & ~full).sum())

    def content(self) -> Content:
        """Return the content that all cards make together."""
        if not self.grid_points:
            raise FileError(self._path, "has no GRID", check_suffix("a Nastran bulk data file"))
        _, node_ids, points = map(np.concatenate, zip(*self.grid_points, strict=True))
        notes = []
        if self._n_partial:
            partial = f"{self._n_partial:,} elements have some of their mid-nodes only"
            notes.append(f"{partial}: they are read with their corners only.")
        if self._other_cards:
            words = some_names(f"{count:,} {quoted(name)[1:-1]}" for name, count in self._other_cards.items())
            notes.append(unread_note(f"other cards ({words})"))
        blocks = [_block(self._path, kind, np.concatenate(rows), node_ids) for kind, rows in self._elements.items()]
        blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
        return Content(points, tuple(blocks), {ID: node_ids}, notes=tuple(notes))


def _block(path: Path, kind: str, rows: np.ndarray, node_ids: np.ndarray) -> Block:
    """Block of the elements of a kind, of rows of a line, an id, a property and nodes."""
    _, ids, properties, *_ = (rows := rows[np.argsort(rows[:, 0], kind="stable")]).T
    nodes = find_ids(path, node_ids, rows[:, 3:], "node")
    sets = {f"property {one}": np.flatnonzero(properties == one) for one in np.unique(properties).tolist() if one > 0}
    return Block(kind, to_vtk_order(nodes, kind, ORDER), {ID: ids.copy()}, sets)
