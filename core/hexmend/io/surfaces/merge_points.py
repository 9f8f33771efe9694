"""Merging of the points of a surface whose faces do not share them, such as the triangles of an STL file."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import bounds, extent, mask
from hexmend.kernels import closest_point
from hexmend.mesh.topology.close_pairs import close_pairs
from hexmend.mesh.topology.components import components

#: Points at a smaller distance, relative to the diagonal of the bounding box, are merged.
_MERGE_TOLERANCE = 1e-9
#: Largest number of a cell along each axis, of the cells that the places of points on a curve tell apart.
_CURVE_CELLS = 2**21 - 1
_SPREAD = (
    (32, 0x001F00000000FFFF),
    (16, 0x001F0000FF0000FF),
    (8, 0x100F00F00F00F00F),
    (4, 0x10C30C30C30C30C3),
    (2, 0x1249249249249249),
)


def merge_points(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Drop unused points and merge those that coincide up to rounding.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, w) int

    Returns
    -------
    points : (j, 3) float64
        Neighbours are numbered in succession for the most part, whatever the order in the file, so that searches of
        the surface find them in the processor's cache.
    faces : (k, w) int
        Faces of these points.
    """
    used = mask(faces.ravel(), len(points))
    if not used.any():
        return points[:0], faces
    if not used.all():
        points, faces = points[used], (np.cumsum(used) - 1)[faces]
    points, group = _different_points(points)
    distance = _MERGE_TOLERANCE * float(np.linalg.norm(extent(points)))
    pairs = close_pairs(points, distance)
    if len(pairs):
        merged = components(len(points), pairs)
        _, first = np.unique(merged, return_index=True)
        points, group = points[first], merged[group]
    return points, group.take(faces)


def _different_points(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the different ones of points (n, 3), neighbours in succession, and the number of each point there."""
    number = closest_point.numbers_of_different_points(points)
    first = np.empty(number.max() + 1, dtype=np.int64)
    first[number[::-1]] = np.arange(len(points))[::-1]
    points = points.take(first, axis=0)
    order = np.argsort(_places_on_curve(points), kind="stable")
    place = np.empty(len(points), dtype=np.int64)
    place[order] = np.arange(len(points))
    return points.take(order, axis=0), place.take(number)


def _places_on_curve(points: np.ndarray) -> np.ndarray:
    """Places of points (n, 3) on a curve that fills their box, the Z-order of Morton (1966), (n,) uint64."""
    low, high = bounds(points)
    size = float((high - low).max())
    cells = ((points - low) / (size or 1.0) * _CURVE_CELLS).astype(np.uint64)
    code = np.zeros(len(points), dtype=np.uint64)
    for axis in range(3):
        bits = cells[:, axis]
        for shift, kept in _SPREAD:  # two zeros after each bit
            bits = (bits | (bits << np.uint64(shift))) & np.uint64(kept)
        code |= bits << np.uint64(axis)
    return code
