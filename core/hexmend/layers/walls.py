"""Walls with boundary layers: their faces, and the column of hexes on each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


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
        Row of `hexmend.mesh.hexahedron.FACES` of the face through which the column enters each hex; `faces // 2` is the
        direction of the height.
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
        *first, last = named + more
        return f"{', '.join(first)} and {last}" if first else last


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
