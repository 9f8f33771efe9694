"""Points of the cells of a lattice with the largest and the least value."""

from __future__ import annotations

import numpy as np

#: Cells of a lattice up to which a number in float64 tells them apart.
_MAX_CELLS = 2.0**53


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
    place = np.floor((x - x.min(axis=0, initial=np.inf)) / cell)
    layers = place.max(axis=0, initial=0.0) + 1
    if layers.prod() < _MAX_CELLS:
        number = (place[:, 0] * layers[1] + place[:, 1]) * layers[2] + place[:, 2]
    else:
        number = np.unique(place, axis=0, return_inverse=True)[1].astype(np.float64)
    order = np.lexsort((distances, number))
    changes = np.ones(order.size + 1, dtype=bool)
    changes[1:-1] = number[order[1:]] != number[order[:-1]]
    return np.sort(order[changes[1:] | changes[:-1]])
