"""Points of the cells of a lattice with the largest and the least value."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import bounds
from hexmend.kernels import closest_point

#: Cells of a lattice for each point up to which a table of all cells is small.
_MAX_CELLS = 16


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
    layers = bounds(place)[1] + 1
    if layers.prod() <= _MAX_CELLS * len(x):
        cells = int(layers.prod())
        number = ((place[:, 0] * layers[1] + place[:, 1]) * layers[2] + place[:, 2]).astype(np.int32)
    else:
        filled, number = np.unique(place, axis=0, return_inverse=True)
        cells, number = len(filled), number.reshape(-1).astype(np.int32)
    return np.flatnonzero(closest_point.extremes_in_cells(number, distances, cells))
