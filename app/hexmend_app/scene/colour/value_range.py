"""Value ranges of metrics, for colours, filters and the histogram."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.displacement import hex_quantity
from hexmend.quality import METRICS
from hexmend_app.picture.appearance import RangeMode, ValueRange


def within(values: np.ndarray, inverted: np.ndarray, chosen: ValueRange) -> np.ndarray:
    """Return True for the hexes in a range, (m,) bool, which are exactly those that the histogram counts in it.

    Parameters
    ----------
    values : (m,) float64
        Values of the metric of the range; nan is treated as inverted.
    inverted : (m,) bool
    chosen : ValueRange
    """
    least, most = METRICS[chosen.metric].full_range
    special = inverted | np.isnan(values)
    inside = ~special if chosen.high > -np.inf else np.zeros(len(values), dtype=bool)
    if chosen.low > least:
        inside &= values >= chosen.low
    if chosen.high < most:
        inside &= values <= chosen.high
    return inside | special if chosen.inverted else inside


def better(metric: str) -> int:
    """Return 1 if greater values of a metric are better, -1 if smaller ones are, else 0."""
    return hex_quantity(metric).better


def declared_range(metric: str, mode: RangeMode) -> tuple[float, float] | None:
    """Return the range of a metric in the mode FULL or ACCEPTABLE; None if it is infinite."""
    declared = hex_quantity(metric).full_range if mode is RangeMode.FULL else hex_quantity(metric).acceptable
    return tuple(map(float, declared)) if np.isfinite(declared).all() else None
