"""Points of the cells of a lattice with the largest and the least value."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import bounds


def extremes_in_cells(x: np.ndarray, distances: np.ndarray, cell: float) -> np.ndarray:
    """Find the points with the largest and with the least distance in each cell of a cubic lattice.

    Parameters
    ----------
    x : (k, 3) float64
    distances : (k,) float64
    cell : float
        Edge of a cell.

    Returns
    -------
    (j,) int64
        Numbers of these points, ascending.

    Examples
    --------
    >>> x = np.array([[0.1, 0, 0], [0.2, 0, 0], [0.3, 0, 0], [1.5, 0, 0]])
    >>> extremes_in_cells(x, np.array([1.0, 2.0, 3.0, 0.0]), 1.0).tolist()
    [0, 2, 3]
    """
    if not len(x):
        return np.empty(0, dtype=np.int64)
    place = np.floor((x - bounds(x)[0]) / cell)
    order = np.lexsort((distances, *place.T))
    first = np.append(True, (np.diff(place[order], axis=0) != 0).any(axis=1))
    return np.unique(order[first | np.roll(first, -1)])
