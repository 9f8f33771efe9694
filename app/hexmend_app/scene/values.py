"""Values of elements and what is declared of them, as colours, filters and histogram ask for them."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.displacement import hex_quantity
from hexmend.quality import METRICS
from hexmend_app.state.look import RangeMode, ValueRange


def within(values: np.ndarray, inverted: np.ndarray, chosen: ValueRange) -> np.ndarray:
    """Which elements a range shows, (m,) bool: exactly those that the histogram counts there.

    Parameters
    ----------
    values : (m,) float64
        Of the range's metric. What is no number is counted as inverted.
    inverted : (m,) bool
    chosen : ValueRange
    """
    least, most = METRICS[chosen.metric].full_range
    apart = inverted | np.isnan(values)
    inside = ~apart if chosen.high > -np.inf else np.zeros(len(values), dtype=bool)
    if chosen.low > least:
        inside &= values >= chosen.low
    if chosen.high < most:
        inside &= values <= chosen.high
    return inside | apart if chosen.inverted else inside


def better(metric: str) -> int:
    """1 for a metric of which more is better, -1 where less is, 0 where neither is."""
    return hex_quantity(metric).better


def declared_range(metric: str, mode: RangeMode) -> tuple[float, float] | None:
    """The range that a metric itself declares for the mode FULL or ACCEPTABLE; None where an end of it is infinite."""
    declared = hex_quantity(metric).full_range if mode is RangeMode.FULL else hex_quantity(metric).acceptable
    return tuple(map(float, declared)) if np.isfinite(declared).all() else None
