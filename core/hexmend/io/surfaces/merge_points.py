"""Merging of the points of a surface whose faces do not share them, such as the triangles of an STL file."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import differing_rows, mask
from hexmend.mesh.topology.close_pairs import LATTICE_FREE_DIRECTION, close_pairs
from hexmend.mesh.topology.components import components

#: Points at a smaller distance, relative to the diagonal of the bounding box, are merged.
_MERGE_TOLERANCE = 1e-9


def merge_points(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Drop unused points and merge those that coincide up to rounding.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, w) int

    Returns
    -------
    points : (j, 3) float64
        Sorted by x, then y, then z, but for those that differ by rounding.
    faces : (k, w) int
        Faces of these points.
    """
    used = mask(faces.ravel(), len(points))
    if not used.any():
        return points[:0], faces
    row = np.cumsum(used) - 1
    points, group = _equal_points(points[used])
    distance = _MERGE_TOLERANCE * float(np.linalg.norm(np.ptp(points, axis=0)))
    merged = components(len(points), close_pairs(points, distance))
    _, first = np.unique(merged, return_index=True)
    return points[first], merged[group[row]][faces]


def _equal_points(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the different ones of points (n, 3), sorted by x, then y, then z, and the number of each point there.

    Two that are equal may both be returned.
    """
    points = points + 0.0  # 0 and -0 are one
    order = np.argsort(points @ LATTICE_FREE_DIRECTION)  # twice as fast as a stable order, and equal points are one
    sorted_points = points[order]
    first = np.append(True, differing_rows(sorted_points[1:], sorted_points[:-1]))
    number = np.empty(len(points), dtype=np.int64)
    number[order] = np.cumsum(first) - 1
    points = sorted_points[first]
    order = np.lexsort(points.T[::-1])
    place = np.empty(len(points), dtype=np.int64)
    place[order] = np.arange(len(points))
    return points[order], place[number]
