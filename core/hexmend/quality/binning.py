"""Counting values by bins in one pass: while a million elements move, the window has no time for more."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import binning
from hexmend.mesh.validation import as_bools, as_reals


def bin_counts(
    values: np.ndarray,
    inverted: np.ndarray,
    ends: tuple[float, float],
    bins: int,
    open_low: bool = False,
    open_high: bool = False,
) -> np.ndarray:
    """How many values lie in each of so many equal bins, (bins + 3,) int64: after them above, below and inverted.

    Values beyond an end that is not open belong to the bin there: they are so by rounding.

    Parameters
    ----------
    values : (m,) float64
    inverted : (m,) bool
        These have no place among the bins.
    ends : (low, high)
        What the bins span.
    bins : int
    open_low, open_high : bool

    Examples
    --------
    >>> bin_counts(np.array([-1.0, 0.0, 0.3, 1.0, 7.0]), np.zeros(5, bool), (0.0, 1.0), 2, open_high=True).tolist()
    [3, 0, 2, 0, 0]
    """
    counts = np.empty(bins + 3, dtype=np.int64)
    low, high = ends
    values = as_reals(values, "values")
    if values.ndim != 1:
        raise MeshError(f"values have shape {values.shape}: expected (m,)")
    inverted = as_bools(inverted, "inverted", len(values))
    binning.count(values, inverted, float(low), bins / (high - low), open_low, open_high, counts)
    return counts
