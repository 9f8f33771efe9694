"""Pairs of points that lie almost at one position."""

from __future__ import annotations

import numpy as np

#: A direction along which the points of no lattice coincide; its length is 1.
LATTICE_FREE_DIRECTION = np.array([0.5378216, 0.6219573, 0.5690947]) / np.linalg.norm([0.5378216, 0.6219573, 0.5690947])


#: Neighbours of a point in the order along it, beyond which a tree finds the pairs sooner.
_MAX_NEIGHBOURS = 64


def close_pairs(points: np.ndarray, distance: float) -> np.ndarray:
    """Find the pairs of points that are no further apart than a distance, small beside that of their neighbours.

    Points of a pair are as close along any direction: they follow each other closely in the order along it.

    Parameters
    ----------
    points : (n, 3) float64
    distance : float
        In the unit of the points.

    Returns
    -------
    (k, 2) int64
        The smaller number first; in no particular order.
    """
    along = points @ LATTICE_FREE_DIRECTION
    order = np.argsort(along)
    along, found = along[order], [np.empty((0, 2), dtype=np.int64)]
    reach = distance + 4 * np.finfo(float).eps * float(np.abs(along).max(initial=0.0))
    first = np.arange(len(points))
    for offset in range(1, len(points)):
        first = first[first + offset < len(points)]
        first = first[along[first + offset] - along[first] <= reach]
        if not first.size:
            break
        if offset > _MAX_NEIGHBOURS:
            from scipy.spatial import cKDTree

            return cKDTree(points).query_pairs(distance, output_type="ndarray")
        pairs = order[np.stack([first, first + offset], axis=1)]
        close = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1) <= distance
        found.append(pairs[close])
    return np.sort(np.concatenate(found), axis=1)
