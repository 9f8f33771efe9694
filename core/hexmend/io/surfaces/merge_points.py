"""Merging of the points of a surface whose faces do not share them, such as the triangles of an STL file."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import differing_rows, mask, row_norms
from hexmend.mesh.topology.components import components

#: Points at a smaller distance, relative to the diagonal of the bounding box, are merged.
_MERGE_TOLERANCE = 1e-9
#: Unit vector along which points are sorted: few surfaces have a plane at right angles to it.
SORT_DIRECTION = np.array([0.53181, 0.64983, 0.54307]) / np.linalg.norm([0.53181, 0.64983, 0.54307])
#: Points with as many others beside them along that direction are searched in space.
_MOST_STEPS = 50


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
    merged = components(len(points), _close_pairs(points, distance))
    _, first = np.unique(merged, return_index=True)
    return points[first], merged[group[row]][faces]


def _equal_points(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the different ones of points (n, 3), sorted by x, then y, then z, and the number of each point there.

    Two that are equal may both be returned.
    """
    order = np.argsort(points @ SORT_DIRECTION, kind="stable")
    sorted_points = points[order]
    first = np.append(True, differing_rows(sorted_points[1:], sorted_points[:-1]))
    number = np.empty(len(points), dtype=np.int64)
    number[order] = np.cumsum(first) - 1
    points = sorted_points[first]
    order = np.lexsort(points.T[::-1])
    place = np.empty(len(points), dtype=np.int64)
    place[order] = np.arange(len(points))
    return points[order], place[number]


def _close_pairs(points: np.ndarray, distance: float) -> np.ndarray:
    """Find the pairs of points (n, 3) that are no further apart than a small distance, (k, 2)."""
    along = (points - points.mean(axis=0)) @ SORT_DIRECTION
    order, reach = np.argsort(along), distance + 1e-15 * float(np.abs(along).max())
    along, pairs = along[order], [np.empty((0, 2), dtype=np.int64)]
    for step in range(1, _MOST_STEPS):
        near = np.flatnonzero(along[step:] - along[:-step] <= reach)
        if not near.size:
            return np.concatenate(pairs)
        both = np.stack([order[near], order[near + step]], axis=1)
        pairs.append(both[row_norms(points[both[:, 1]] - points[both[:, 0]]) <= distance])
    from scipy.spatial import cKDTree

    return cKDTree(points).query_pairs(distance, output_type="ndarray")
