"""Connected components.

Pairs of points that lie almost at one position.

Faces, hexes and other rows of nodes with at least one marked node.
"""

from __future__ import annotations

import numpy as np

from hexmend.kernels import incidence


def components(count: int, *groups: np.ndarray) -> np.ndarray:
    """Number the connected components of some items.

    Parameters
    ----------
    count : int
        Number of items.
    *groups : (k, w) int
        Each row holds items that are connected, such as the two ends of an edge or the nodes of a cell.

    Returns
    -------
    (count,) int32
        Component of each item, numbered from 0 in the order of their lowest items.

    Examples
    --------
    >>> components(5, np.array([[1, 3], [0, 4]]))
    array([0, 1, 2, 1, 0], dtype=int32)
    """
    parent = np.arange(count, dtype=np.int32)
    for group in groups:
        incidence.join(parent, np.ascontiguousarray(group, np.int32).ravel(), group.shape[1])
    own = parent == np.arange(count, dtype=np.int32)  # the lowest items of components
    while not own[parent].all():
        parent = parent[parent]
    return (np.cumsum(own, dtype=np.int32) - 1)[parent]


def components_of_cells(count: int, cells: np.ndarray, *others: np.ndarray) -> np.ndarray:
    """Number the components of cells that are connected by common nodes.

    Parameters
    ----------
    count : int
        Number of nodes.
    cells : (m, w) int
        Nodes of each cell.
    *others : (k, w) int
        Nodes of cells that connect these, without being numbered.

    Returns
    -------
    (m,) int64
        Component of each of `cells`, numbered from 0 in the order of their first cells.
    """
    _, first, component = np.unique(
        components(count, cells, *others)[cells[:, 0]], return_index=True, return_inverse=True
    )
    return np.argsort(np.argsort(first))[component]


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


def any_of_rows(marks: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mark rows (k, w) of numbers with at least one number marked in `marks` (n,) bool, (k,) bool.

    >>> any_of_rows(np.array([True, False, False]), np.array([[1, 2], [2, 0]])).tolist()
    [False, True]
    """
    found = marks.take(rows[:, 0])  # in half the time of marks[...]
    for column in range(1, rows.shape[1]):
        found |= marks.take(rows[:, column])
    return found
