"""Counting for the histogram: arrays in, arrays out."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend.quality.binning import bin_counts
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.picture.appearance import ValueRange
from hexmend_app.scene.colour.value_range import within

#: Bins at first, and how few and how many there can be.
BINS, FEWEST, MOST = 50, 10, 200


@dataclass(frozen=True, eq=False)
class Distribution:
    """Distribution of the elements' values.

    Parameters
    ----------
    values : (m,) float64
        Of a metric.
    is_inverted : (m,) bool
    axis : Axis
    counts : (bins,) int64
        Elements that are not inverted, by value.
    inverted, below, above : int
        Inverted elements, and others beyond the ends of the axis.
    """

    values: np.ndarray
    is_inverted: np.ndarray
    axis: Axis
    counts: np.ndarray
    inverted: int
    below: int
    above: int

    @property
    def total(self) -> int:
        """Number of elements."""
        return len(self.values)

    @property
    def edges(self) -> np.ndarray:
        """Ends of the bins as values, (bins + 1,) float64."""
        return np.linspace(self.axis.low, self.axis.high, len(self.counts) + 1)

    @property
    def cells(self) -> Cells:
        """Everything that counts elements, from left to right."""
        return Cells(self.axis, len(self.counts))

    def cumulated(self) -> Distribution:
        """The same with each count raised by those left of it: inverted elements first, those above the axis last."""
        below = self.inverted + self.below
        counts = below + np.cumsum(self.counts)
        return Distribution(self.values, self.is_inverted, self.axis, counts, self.inverted, below, self.total)

    def within(self, chosen: ValueRange) -> int:
        """Return the number of elements that a range of the axis' metric shows."""
        return int(np.count_nonzero(within(self.values, self.is_inverted, chosen)))


def distribute(values: np.ndarray, inverted: np.ndarray, axis: Axis, bins: int = BINS) -> Distribution:
    """Count (m,) values, of which (m,) bool `inverted` says which have no place among the bins.

    >>> part = distribute(np.array([0.0, 0.011, 1.0, 0.3]), np.array([False, False, False, True]), Axis("q"))
    >>> part.counts[[0, 49]].tolist(), part.inverted
    ([2, 1], 1)
    """
    values, inverted = np.asarray(values, dtype=np.float64), np.asarray(inverted, dtype=bool)
    if values.ndim != 1 or values.shape != inverted.shape:
        raise ValueError(
            f"values have shape {values.shape} and inverted {inverted.shape}: expected one row of the same length each"
        )
    counts = bin_counts(values, inverted, (axis.low, axis.high), bins, axis.open_low, axis.open_high)
    return Distribution(values, inverted, axis, counts[:bins], *(int(counts[bins + k]) for k in (2, 1, 0)))


def round_up(value: float) -> float:
    """The next round number that is not less, so that an axis holds still while counts change.

    >>> [round_up(v) for v in (0.5, 1.1, 640, 32735)]
    [1.0, 1.5, 800.0, 40000.0]
    """
    value = max(value, 1.0)
    power = 10.0 ** np.floor(np.log10(value))
    return next(float(m * power) for m in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if m * power >= value * (1 - 1e-12))


def decades(top: float) -> list[int]:
    """Powers of ten from 1 up to `top`.

    >>> decades(40000)
    [1, 10, 100, 1000, 10000]
    """
    return [10**k for k in range(math.floor(math.log10(top) + 1e-9) + 1)]
