"""Values of elements and what is declared of them, as colours, filters and histogram ask for them."""

from __future__ import annotations

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.state.look import RangeMode, ValueRange
from hexmend_app.state.movement import named


def within(values: np.ndarray, chosen: ValueRange) -> np.ndarray:
    """True for each value of the range's metric that lies in the range, (m,) bool."""
    least, most = METRICS[chosen.metric].full_range
    inside = np.ones(len(values), dtype=bool)
    if chosen.low > least:
        inside &= values >= chosen.low
    if chosen.high < most:
        inside &= values <= chosen.high
    return inside


def better(metric: str) -> int:
    """1 for a metric of which more is better, -1 where less is, 0 where neither is."""
    return named(metric).better


def declared_range(metric: str, mode: RangeMode) -> tuple[float, float] | None:
    """The range that a metric itself declares for the mode FULL or ACCEPTABLE; None where an end of it is infinite."""
    declared = named(metric).full_range if mode is RangeMode.FULL else named(metric).acceptable
    return tuple(map(float, declared)) if np.isfinite(declared).all() else None
