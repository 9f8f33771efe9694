"""Columns of hexes that stand on faces of the boundary."""

from __future__ import annotations

import numpy as np

#: Ratio of successive heights, up or down, beyond which a column ends. Boundary layers grow by 1.05 to 2.
GREATEST_RATIO = 2.5


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
        continues = (following >= 0) & (meets.sum(axis=1) == 1)  # a column returns only through hexes that meet twice
        continues &= flat & (ratio <= GREATEST_RATIO) & (ratio >= 1 / GREATEST_RATIO)
        active, current, entry = active[continues], following[continues], side[continues]
        if active.size:
            hexes, faces = np.full_like(table[0][0], -1), np.zeros_like(table[0][1])
            hexes[active], faces[active] = current, entry
            table.append((hexes, faces))
    columns, entries = zip(*table, strict=True)
    return np.stack(columns, axis=1), np.stack(entries, axis=1)
