"""Histogram counts in one pass, fast enough to follow a million hexes as they move."""

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
    """Count values in equal bins.

    Parameters
    ----------
    values : (m,) float64
    inverted : (m,) bool
        True for values that are counted apart.
    ends : (low, high)
        Range of the bins.
    bins : int
        Number of bins.
    open_low, open_high : bool
        Count values below or above the range apart; otherwise they are outside by rounding and fall in the end bin.

    Returns
    -------
    (bins + 3,) int64
        Counts of the bins, then of the values above, below and inverted.

    Raises
    ------
    MeshError
        For arrays of another shape or type.

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
