"""Columns of hexes that stand on faces of the boundary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

#: Lengths (k, 3) of some hexes (k,) along their own directions.
Lengths = Callable[[np.ndarray], np.ndarray]

#: Most layers of a column.
MAX_LAYERS = 500
#: Ratios of successive heights with which a column goes on; on a wall that is named, heights may also fall.
LEAST_RATIO, GREATEST_RATIO = 0.97, 2.5
LEAST_RATIO_NAMED = 1 / GREATEST_RATIO
#: Height, as a multiple of the lateral length, from which on a hex is not part of a layer.
ISOTROPIC = 1.0


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns of hexes with steadily growing heights.

    Parameters
    ----------
    hexes : (w, k) int32
        From the wall inwards; -1 where a column has ended.
    faces : (w, k) int8
        The face through which the column enters each hex.
    heights : (w, k) float64
        NaN where a column has ended.
    """

    hexes: np.ndarray
    faces: np.ndarray
    heights: np.ndarray

    @property
    def layers(self) -> np.ndarray:
        """Number of layers of each column, (w,)."""
        return (self.hexes >= 0).sum(axis=1)

    @property
    def growth(self) -> np.ndarray:
        """Mean ratio of successive heights of each column, (w,); 1 for a column of one hex."""
        layers = self.layers
        last = self.heights[np.arange(len(layers)), layers - 1]
        return (last / self.heights[:, 0]) ** (1 / np.maximum(layers - 1, 1))

    @property
    def unsteadiness(self) -> np.ndarray:
        """Mean change of the logarithm of the ratio from layer to layer, (w,); 0 for columns of two hexes or less."""
        changes = np.abs(np.diff(np.log(self.heights), n=2, axis=1))
        return np.nansum(changes, axis=1) / np.maximum((~np.isnan(changes)).sum(axis=1), 1)

    def separated(self, n_hexes: int) -> Columns:
        """Leave each hex to the column on whose wall it is nearer, of columns that meet from opposite walls.

        Parameters
        ----------
        n_hexes : int
            Number of hexes of the mesh.
        """
        there = self.hexes >= 0
        direction = 3 * self.hexes.astype(np.int64) + self.faces // 2
        layer = np.broadcast_to(np.arange(self.hexes.shape[1]), self.hexes.shape)
        nearest = np.full(3 * n_hexes, self.hexes.shape[1])
        np.minimum.at(nearest, direction[there], layer[there])
        own = there & (layer <= nearest[np.where(there, direction, 0)])
        return Columns(np.where(own, self.hexes, -1), self.faces, np.where(own, self.heights, np.nan))

    def rows(self, which: np.ndarray) -> Columns:
        """Return some of the columns."""
        depth = int(self.layers[which].max(initial=1))
        return Columns(self.hexes[which, :depth], self.faces[which, :depth], self.heights[which, :depth])


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
    neighbours: np.ndarray, lengths: Lengths, hexes: np.ndarray, faces: np.ndarray, least_ratio: float = LEAST_RATIO
) -> Columns:
    """Follow columns from faces of the boundary inwards, through opposite faces, while their heights grow steadily.

    Parameters
    ----------
    neighbours : (m, 6) int32
        `Topology.face_neighbours`.
    lengths : callable
        Returns the lengths of some hexes.
    hexes, faces : (w,) int
        The faces of the boundary.
    least_ratio : float
        Least ratio of successive heights.

    Returns
    -------
    Columns
    """
    rows, hexes, faces = np.arange(len(hexes)), hexes.astype(np.int32), faces.astype(np.int8)
    height = lengths(hexes)[rows, faces // 2]
    table = [(hexes.copy(), faces.copy(), height.copy())]
    active, current, entry = rows, hexes, faces
    for _ in range(MAX_LAYERS - 1):
        following = neighbours[current, entry ^ 1]
        inside = following >= 0
        active, current, height, following = active[inside], current[inside], height[inside], following[inside]
        if not active.size:
            break
        entry = (neighbours[following] == current[:, None]).argmax(axis=1).astype(np.int8)
        size = lengths(following)
        upper = size[np.arange(len(size)), entry // 2]
        lateral = lateral_lengths(size, entry, neighbours[following])
        continues = (upper >= least_ratio * height) & (upper <= GREATEST_RATIO * height) & (upper < ISOTROPIC * lateral)
        active, current, entry, height = active[continues], following[continues], entry[continues], upper[continues]
        if not active.size:
            break
        hex, side, size = np.full(len(hexes), -1, np.int32), np.zeros(len(hexes), np.int8), np.full(len(hexes), np.nan)
        hex[active], side[active], size[active] = current, entry, height
        table.append((hex, side, size))
    return Columns(*(np.stack(columns, axis=1) for columns in zip(*table, strict=True)))
