"""Connected components.

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


def any_of_rows(marks: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mark rows (k, w) of numbers with at least one number marked in `marks` (n,) bool, (k,) bool.

    >>> any_of_rows(np.array([True, False, False]), np.array([[1, 2], [2, 0]])).tolist()
    [False, True]
    """
    found = marks.take(rows[:, 0])  # in half the time of marks[...]
    for column in range(1, rows.shape[1]):
        found |= marks.take(rows[:, column])
    return found
