"""Value ranges of metrics, for colours, filters and the histogram."""

from __future__ import annotations

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.picture.colours import Range, colour_quantity
from hexmend_app.picture.visibility import Show

#: Metrics that are positive for hexes that are not inverted, and for no others.
_POSITIVE = ("scaled-jacobian",)


def within(values: np.ndarray, inverted: np.ndarray, show: Show) -> np.ndarray:
    """Return True for the hexes in a range, (m,) bool, which are exactly those that the histogram counts in it.

    An end of the full range of the metric is no bound, because rounding can make q slightly larger than 1. A range that
    ends at -inf contains no value.

    Parameters
    ----------
    values : (m,) float64
        Values of the metric of the range; a hex without a value, nan, is in none.
    inverted : (m,) bool
    show : Show
        Filter by quality; its other filters are ignored.
    """
    least, most = METRICS[show.metric].full_range
    inside = ~(inverted | np.isnan(values)) if show.high > -np.inf else np.zeros(len(values), dtype=bool)
    if show.low > least:
        inside &= values >= show.low
    if show.high < most:
        inside &= values <= show.high
    return inside | inverted if show.inverted else inside


def better(metric: str) -> int:
    """Return 1 if greater values of a metric are better, -1 if smaller ones are, else 0."""
    return colour_quantity(metric).better


def declared_range(metric: str, range: Range) -> tuple[float, float] | None:
    """Return the FULL or ACCEPTABLE range of a metric; None if it is infinite.

    The full range of the scaled Jacobian begins at 0: hexes of lower values are inverted and have their own colour.
    """
    declared = colour_quantity(metric).full_range if range is Range.FULL else colour_quantity(metric).acceptable
    if metric in _POSITIVE and range is Range.FULL:
        declared = 0.0, declared[1]
    return (float(declared[0]), float(declared[1])) if np.isfinite(declared).all() else None
