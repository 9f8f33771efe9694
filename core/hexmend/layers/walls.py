"""Walls with boundary layers: their faces, and the column of hexes on each.

Columns of hexes that stand on faces of the boundary.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.solid_cells import SOLID_KINDS, WEDGE, face_nodes, kinds_of
from hexmend.terminal_text import listed

#: Ratio of successive heights, up or down, beyond which a column ends. Boundary layers grow by 1.05 to 2.
GREATEST_RATIO = 2.5
#: Number of the kind of wedges.
WEDGES = SOLID_KINDS.index(WEDGE)


def nodes_of_faces(elements: np.ndarray, cells: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Nodes of faces through which columns go, (k, 4): of hexes, and 4 and 5 for the triangles of wedges."""
    return face_nodes(elements, cells, faces - 4 * (kinds_of(elements[cells]) == WEDGES))


def lateral_lengths(lengths: np.ndarray, faces: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """Shorter of the two lengths across the direction of a face.

    A direction with the boundary on both sides, as the span of a two-dimensional mesh has, does not count.

    Parameters
    ----------
    lengths : (k, 3) float64
        Of hexes.
    faces : (k,) int
    neighbours : (k, 6) int32
        Hexes behind the faces of each, -1 on the boundary.

    Returns
    -------
    (k,) float64
    """
    rows, across = np.arange(len(lengths)), faces // 2
    spans = np.all(neighbours.reshape(-1, 3, 2) < 0, axis=2)
    spans[rows, across] = True
    sides = np.where(spans, np.inf, lengths)
    shorter = sides.min(axis=1)
    others = lengths.copy()
    others[rows, across] = np.inf
    return np.where(np.isfinite(shorter), shorter, others.min(axis=1))


def walk_columns(
    neighbours: np.ndarray, lengths: np.ndarray, hexes: np.ndarray, faces: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Follow columns from faces of the boundary inwards, through opposite faces.

    A column ends before a hex that is as high as wide, or whose height jumps.

    Parameters
    ----------
    neighbours : (m, 6) int32
        `Topology.face_neighbours`.
    lengths : (m, 3) float64
        Of all hexes.
    hexes, faces : (w,) int
        The faces of the boundary.

    Returns
    -------
    hexes : (w, k) int32
        Hexes of each column, from the wall inwards; -1 where it has ended.
    faces : (w, k) int8
        The face through which the column enters each hex.
    """
    active, hexes, faces = np.arange(len(hexes)), hexes.astype(np.int32), faces.astype(np.int8)
    table, current, entry = [(hexes, faces)], hexes, faces
    while active.size:
        following = neighbours[current, entry ^ 1]
        meets = neighbours[following] == current[:, None]
        side = meets.argmax(axis=1).astype(np.int8)
        ratio = lengths[following, side // 2] / lengths[current, entry // 2]
        flat = lengths[following, side // 2] < lateral_lengths(lengths[following], side, neighbours[following])
        # A column returns only through hexes that meet twice.
        continues = (following >= 0) & (following != current) & (meets.sum(axis=1) == 1)
        continues &= flat & (ratio <= GREATEST_RATIO) & (ratio >= 1 / GREATEST_RATIO)
        active, current, entry = active[continues], following[continues], side[continues]
        if active.size:
            hexes, faces = np.full_like(table[0][0], -1), np.zeros_like(table[0][1])
            hexes[active], faces[active] = current, entry
            table.append((hexes, faces))
    columns, entries = zip(*table, strict=True)
    return np.stack(columns, axis=1), np.stack(entries, axis=1)


@dataclass(frozen=True, eq=False)
class Wall:
    """Connected faces of the boundary with a stack of layers on them.

    Parameters
    ----------
    name : str
        Name of the side set that has the faces, or "wall" with a number.
    hexes : (w, k) int32
        Hexes of the column on each face, from the wall inwards; -1 where a column has ended.
    faces : (w, k) int8
        Row of `hexmend.mesh.hexahedron.FACES` of the face through which the column enters each hex, 4 or 5 in wedges;
        `faces // 2` is the direction of the height.
    """

    name: str
    hexes: np.ndarray
    faces: np.ndarray

    @property
    def count(self) -> int:
        """Number of faces."""
        return len(self.hexes)

    @property
    def depth(self) -> int:
        """Number of layers of most columns."""
        return int(np.median((self.hexes >= 0).sum(axis=1)))

    def of(self, lengths: np.ndarray) -> np.ndarray:
        """Return the heights of the hexes, (w, k), from the lengths (m, 3) of all; NaN where a column has ended."""
        return np.where(self.hexes >= 0, lengths[self.hexes, self.faces // 2], np.nan)


@dataclass(frozen=True, eq=False)
class Layers:
    """Boundary layers of a mesh; false where there are none.

    Parameters
    ----------
    walls : tuple of Wall
        The largest first.
    """

    walls: tuple[Wall, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.walls)

    @property
    def hexes(self) -> np.ndarray:
        """Numbers of the hexes of all stacks, ascending, (k,) int."""
        numbers = [wall.hexes[wall.hexes >= 0] for wall in self.walls]
        return np.unique(np.concatenate(numbers)) if numbers else np.zeros(0, np.int32)

    @property
    def names(self) -> str:
        """Names of the walls in quotes, at most three of them."""
        named = [f"'{wall.name}'" for wall in self.walls[:3]]
        more = [f"{len(self.walls) - 3} more"] if len(self.walls) > 3 else []
        return listed(named + more, "and")


def layers_of_columns(names: np.ndarray, hexes: np.ndarray, faces: np.ndarray, n_hexes: int) -> Layers:
    """Group columns into walls; of columns that meet from opposite walls, each hex belongs to the nearer wall.

    Parameters
    ----------
    names : (w,) str
        Name of each column's wall.
    hexes : (w, k) int32
    faces : (w, k) int8
        See `Wall`.
    n_hexes : int
        Number of hexes of the mesh.
    """
    there = hexes >= 0
    direction = 3 * hexes.astype(np.int64) + faces // 2
    layer = np.broadcast_to(np.arange(hexes.shape[1]), hexes.shape)
    nearest = np.full(3 * n_hexes, hexes.shape[1])
    np.minimum.at(nearest, direction[there], layer[there])
    hexes = np.where(there & (layer <= nearest[direction]), hexes, -1)
    walls = []
    for name in dict.fromkeys(names.tolist()):
        rows = names == name
        deepest = int((hexes[rows] >= 0).any(axis=0).sum())
        walls.append(Wall(name, hexes[rows, :deepest], faces[rows, :deepest]))
    return Layers(tuple(sorted(walls, key=lambda wall: -wall.count)))
