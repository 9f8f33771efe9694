"""Reader of Nastran's bulk data."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import VERTICAL_EDGES_FIRST, Content, to_vtk_order
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.numbering import find_ids
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.decks.cards import Cards
from hexmend.io.formats.decks.model import DeckModel
from hexmend.io.formats.nastran.bulk import BulkData, join
from hexmend.io.formats.nastran.cards import JOINING, KINDS_OF_CARD, NODES_OF_CARD, SOLIDS, element_layout
from hexmend.io.formats.nastran.systems import CoordinateSystems
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

_FEWER_NODES = "Write the elements of second order with the nodes of their corners and edges alone."


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
        For a card that is malformed, a coordinate system that does not exist, or an included file that does not.
    MeshError
        From `Mesh`.
    """
    files = join(path)
    model = BulkModel(path)
    for cards in BulkData(path, files.data, files.place).cards():
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
        self._deck = DeckModel(path, "GRID", "a Nastran bulk data file")
        self._grids: list[Cards] = []
        self._default_system = 0
        self.systems = CoordinateSystems()
        self._n_partial = 0  # elements with some of their mid-nodes only

    def add(self, cards: Cards) -> None:
        """Add cards of one name."""
        if self.add_position(cards):
            return
        if cards.name in KINDS_OF_CARD:
            self._add_elements(cards)
            return
        self._deck.others[cards.name] += len(cards.lines)
        first = NODES_OF_CARD.get(cards.name)
        if first is not None:
            fields = cards.fields(first, int((cards.ends - cards.begins).max()))
            self._deck.fixed[cards.name].append(fields[np.strings.isdigit(fields)].astype(np.int64))
        if cards.name in JOINING or first is not None:
            self._deck.joining.append(cards.name)

    def add_position(self, cards: Cards) -> bool:
        """Add grid points, or the systems of their coordinates; returns False for other cards."""
        if cards.name == "GRID":
            self._grids.append(cards)
        elif cards.name == "GRDSET":
            self._default_system = int(cards.integers(1, 2)[0, 0])
        elif re.fullmatch("CORD[12][RCS]", cards.name):
            self.systems.add(cards)
        else:
            return False
        return True

    def grid_points(self) -> GridPoints:
        """Return the grid points of all cards; raises `FileError` where there are none."""
        if not self._grids:
            self._deck.given_nodes()  # an error
        parts = [(one.lines, one.integers(0, 2), one.reals(2, 5)) for one in self._grids]
        lines, numbers, given = map(np.concatenate, zip(*parts, strict=True))
        ids, systems = numbers.T
        systems = np.where(systems == 0, self._default_system, systems)
        return GridPoints(self._grids[0], lines, ids, systems, given, self.systems)

    def _add_elements(self, cards: Cards) -> None:
        first, linear, quadratic, n_corners, n_nodes = element_layout(cards.name)
        numbers = cards.integers(0, first + n_nodes)
        nodes = numbers[:, first:]
        for at in np.flatnonzero((nodes[:, :n_corners] == 0).any(axis=1))[:1].tolist():
            found = np.count_nonzero(nodes[at, :n_corners])
            raise cards.error(at, f"has {found} nodes: expected {n_corners}", DAMAGED)
        if cards.name in SOLIDS:
            behind = cards.fields(first + n_nodes, max(first + n_nodes + 1, int((cards.ends - cards.begins).max())))
            for at in np.flatnonzero((behind != b"").any(axis=1))[:1].tolist():
                found = n_nodes + np.count_nonzero(behind[at] != b"")
                raise cards.error(at, f"has {found} nodes: expected {n_corners} to {n_nodes}", _FEWER_NODES)
        properties = numbers[:, 1] if first == 2 else np.zeros_like(cards.lines)
        n_mid = np.count_nonzero(nodes[:, n_corners:], axis=1)
        full = (n_mid == n_nodes - n_corners) & bool(quadratic)
        for kind, chosen, width in ((linear, ~full, n_corners), (quadratic, full, n_nodes)):
            if chosen.any():
                own = to_vtk_order(nodes[chosen, :width], kind, VERTICAL_EDGES_FIRST)
                self._deck.add_elements(kind, cards.lines[chosen], numbers[chosen, 0], properties[chosen], own)
        self._n_partial += int(((n_mid > 0) & ~full).sum())

    def content(self) -> Content:
        """Return the content that all cards make together."""
        grid, deck = self.grid_points(), self._deck
        if self._n_partial:
            partial = f"{self._n_partial:,} elements have some of their mid-nodes only"
            deck.notes.append(f"{partial}: they are read with their corners only.")
        if self.systems.grid_points:
            deck.fixed["coordinate systems"].append(np.array(list(self.systems.grid_points)))
        deck.nodes.append((grid.ids, grid.points))
        content = deck.content(lambda number: f"property {number}" if number > 0 else "")
        used = np.zeros(len(grid.ids), dtype=bool)
        for block in content.blocks:
            used[block.nodes] = True
        if n_unplaced := grid.unplaced(used):
            words = count_phrase(
                n_unplaced, "grid point that no element uses is", "grid points that no element uses are"
            )
            note = f"{words} in a coordinate system that the file does not have: read as x, y and z."
            content = replace(content, notes=(*content.notes, note))
        return content


@dataclass(frozen=True, eq=False)
class GridPoints:
    """Grid points in the order of their cards.

    Parameters
    ----------
    cards : Cards
        Some of the cards, for errors.
    lines : (n,) int64
        First line of each card, from 1.
    ids : (n,) int64
    systems : (n,) int64
        Number of each one's coordinate system.
    given : (n, 3) float64
        Coordinates in that system.
    known : CoordinateSystems
    """

    cards: Cards
    lines: np.ndarray
    ids: np.ndarray
    systems: np.ndarray
    given: np.ndarray
    known: CoordinateSystems

    @cached_property
    def points(self) -> np.ndarray:
        """Basic coordinates, (n, 3) float64."""
        points = self.given.copy() if self.systems.any() else self.given
        for number, rows in self._groups():
            points[rows] = self.known.to_basic(number, self.given[rows], self._point)
        return points

    def in_file(self, points: np.ndarray) -> np.ndarray:
        """Convert basic coordinates to those of the cards, (n, 3); unchanged points have the coordinates given."""
        local, changed = points.copy(), ~(points == self.points).all(axis=1)
        for number, rows in self._groups():
            local[rows] = self.known.from_basic(number, points[rows], self._point)
            same = rows[~changed[rows]]
            local[same] = self.given[same]
        return local

    def unplaced(self, used: np.ndarray) -> int:
        """Number of points whose system does not exist; raises `FileError` if an element uses one."""
        unknown = ~np.isin(self.systems, [0, *self.known.numbers])
        if (wrong := unknown & used).any():
            at = int(wrong.argmax())
            place = f"GRID in {self.cards.place(int(self.lines[at]))} is in the coordinate system {self.systems[at]}"
            raise FileError(self.cards.path, f"{place}, which the file does not have", "Add its CORD card.")
        return int(unknown.sum())

    def _groups(self) -> Iterator[tuple[int, np.ndarray]]:
        for number in np.unique(self.systems[self.systems != 0]).tolist():
            if number in self.known.numbers:
                yield number, np.flatnonzero(self.systems == number)

    def _point(self, number: int) -> np.ndarray:
        """Basic coordinates of a grid point that defines a coordinate system, (3,)."""
        at = int(find_ids(self.cards.path, self.ids, np.array([number]), "node")[0])
        return self.known.to_basic(int(self.systems[at]), self.given[at : at + 1], self._point)[0]
