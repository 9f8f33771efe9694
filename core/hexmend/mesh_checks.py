"""What points and node numbers have to be before they are a mesh's."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError

#: The largest coordinate and the least size of a mesh: beyond them fourth powers of lengths are no numbers.
LARGEST, SMALLEST = 1e75, 1e-75


def check_size(points: np.ndarray) -> None:
    """Raise `MeshError` where points (n, 3) are so far apart, or so near, that volumes are no numbers."""
    if not len(points):
        return
    low, high = points.min(axis=0), points.max(axis=0)
    far, size = max(-low.min(), high.max()), float((high - low).max())
    if far > LARGEST:
        raise MeshError(f"coordinates go up to {far:.3g}: expected {LARGEST:g} at most; choose a larger unit of length")
    if 0 < size < SMALLEST:
        raise MeshError(f"the mesh is {size:.3g} wide: expected {SMALLEST:g} at least; choose a smaller unit of length")


def check_finite(points: np.ndarray) -> None:
    """Raise `MeshError` naming the first of points (n, 3) whose coordinates are not all finite."""
    if not np.isfinite(points).all():
        i = int(np.nonzero(~np.isfinite(points).all(axis=1))[0][0])
        raise MeshError(f"node {i} (counted from 0) has the coordinates {points[i].tolist()}: expected finite numbers")


def check_node_numbers(hexes: np.ndarray, n: int) -> None:
    """Raise `MeshError` naming the first of hexes (m, 8) that uses a node which is none of the n."""
    if hexes.min() < 0 or hexes.max() >= n:
        h = int(np.nonzero(((hexes < 0) | (hexes >= n)).any(axis=1))[0][0])
        raise MeshError(
            f"hex {h} (counted from 0) uses the nodes {hexes[h].tolist()}: expected numbers from 0 to {n - 1}"
        )
