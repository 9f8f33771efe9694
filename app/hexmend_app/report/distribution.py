"""Distribution of the values of a metric over hexes, and the axis on which it is counted in bins."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.colour.colouring import range_label
from hexmend_app.scene.colour.ticks import nice_ticks
from hexmend_app.scene.colour.value_range import within
from hexmend_app.translation import tr

#: Default, minimum and maximum number of bins.
DEFAULT_BINS, MIN_BINS, MAX_BINS = 50, 10, 200

_MAX_TICKS = 7
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True, eq=False)
class Distribution:
    """Values of the cells of a mesh; inverted cells are only counted, cells without a value, NaN, left out.

    Parameters
    ----------
    values : (k,) float64
        Values of the other cells, ascending.
    inverted : int
    noun : str
        Word for one of the cells.
    """

    values: np.ndarray
    inverted: int
    noun: str = "hex"

    @classmethod
    def of(cls, values: np.ndarray, inverted: np.ndarray, noun: str = "hex") -> Distribution:
        """Return the distribution of values, (m,) float; `inverted`, (m,) bool, is True for inverted cells.

        Raises
        ------
        ValueError
            If `values` and `inverted` differ in shape.
        """
        values, inverted = np.asarray(values, dtype=np.float64), np.asarray(inverted, dtype=bool)
        if values.ndim != 1 or values.shape != inverted.shape:
            shapes = f"values have shape {values.shape} and inverted {inverted.shape}"
            raise ValueError(f"{shapes}: expected 1-D arrays of the same length")
        valid = np.sort(values[~(inverted | np.isnan(values))])
        return cls(valid, int(np.count_nonzero(inverted)), noun)

    @property
    def total(self) -> int:
        """Number of cells that are inverted or have a value."""
        return len(self.values) + self.inverted

    @property
    def finite(self) -> np.ndarray:
        """The finite values, ascending."""
        first, last = np.searchsorted(self.values, -np.inf, "right"), np.searchsorted(self.values, np.inf)
        return self.values[first:last]

    def within(self, range: Show) -> int:
        """Return the number of hexes in a range of the metric."""
        inside = within(self.values, np.zeros(len(self.values), bool), range)
        return int(np.count_nonzero(inside)) + self.inverted * range.inverted

    def counts(self, axis: Axis, cumulative: bool = False) -> np.ndarray:
        """Return the number of hexes in each bin, (bins,) int64; with `cumulative`, all up to it, inverted ones first.

        Values below the axis are counted in the first bin, those above it in the last one.

        Examples
        --------
        >>> three = Distribution.of(np.array([0.0, 0.011, 1.0, 0.3]), np.array([False, False, False, True]))
        >>> three.counts(Axis("q", bins=10)).tolist(), three.inverted
        ([2, 0, 0, 0, 0, 0, 0, 0, 0, 1], 1)
        """
        ends = np.searchsorted(self.values, axis.edges[1:-1])
        counts = np.diff(ends, prepend=0, append=len(self.values))
        return self.inverted + np.cumsum(counts) if cumulative else counts


@dataclass(frozen=True)
class Axis:
    """Axis of a metric with bins of equal width; on a plot, bin k spans k to k + 1.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    low, high : float
        Ends of the axis.
    below, above : bool
        True if there are values beyond the end, which its bin counts.
    bins : int
    """

    metric: str
    low: float = 0.0
    high: float = 1.0
    below: bool = False
    above: bool = False
    bins: int = DEFAULT_BINS

    @classmethod
    def fitted(cls, metric: str, distributions: Iterable[Distribution], bins: int = DEFAULT_BINS) -> Axis:
        """Return the axis of a metric for some distributions, with round ends.

        It spans all values of a bounded metric. Of an unbounded one it spans 99 % of each distribution, but at most
        three interquartile ranges beyond the quartiles.

        Examples
        --------
        >>> none = np.zeros(50, bool)
        >>> Axis.fitted("aspect-ratio", [Distribution.of(np.linspace(1, 2.7, 50), none)])
        Axis(metric='aspect-ratio', low=1.0, high=2.75, below=False, above=False, bins=50)
        """
        minimum, maximum = METRICS[metric].full_range
        values = [finite for one in distributions if len(finite := one.finite)]
        if not values:
            values = [np.array([end for end in METRICS[metric].acceptable if math.isfinite(end)] or [0.0])]
        ends = [(one[0], one[-1]) if math.isfinite(maximum) else _bulk(one) for one in values]
        low, high = float(min(low for low, _ in ends)), float(max(high for _, high in ends))
        if high - low <= 1e-6 * abs(high):
            low, high = low - (abs(low) / 2 or 0.5), high + (abs(high) / 2 or 0.5)
        low, high = max(low, minimum), min(high, maximum)
        ticks = nice_ticks(low, high, _MAX_TICKS)
        step = ticks[1] - ticks[0]
        low = max(_multiple(step, math.floor(low / step + 1e-9)), minimum)
        high = min(_multiple(step, math.ceil(high / step - 1e-9)), maximum)
        below = low > minimum and any(one[0] < low for one in values)
        above = high < maximum and any(one[-1] > high for one in values)
        return cls(metric, low, high, below, above, bins)

    # Positions on the plot

    @property
    def edges(self) -> np.ndarray:
        """Values at the ends of the bins, (bins + 1,) float64."""
        return np.linspace(self.low, self.high, self.bins + 1)

    def position(self, value: float) -> float:
        """Return the position of a value on the plot; beyond the axis, that of its nearest end."""
        return min(max((value - self.low) / (self.high - self.low), 0.0), 1.0) * self.bins

    def range(self, left: float, right: float) -> Show | None:
        """Return the range between two positions on the plot, rounded; None if it contains all hexes.

        A range that ends left of the bins is that of inverted hexes; one that begins there includes them.
        """
        if right < 0:
            return Show((-math.inf, -math.inf), self.metric, inverted=True)
        if left < 0 and right >= self.bins:
            return None
        low, high = METRICS[self.metric].full_range
        values = [round(self.low + at * (self.high - self.low) / self.bins, self.decimals) for at in (left, right)]
        ends = low if left <= 0 else values[0], high if right >= self.bins else values[1]
        return Show(ends, self.metric, inverted=left < 0)

    def bin_range(self, bin: int) -> Show:
        """Return the range of exactly the hexes that a bin counts."""
        low, high = METRICS[self.metric].full_range
        edges = self.edges
        if bin > 0:
            low = float(edges[bin])
        if bin < self.bins - 1:
            high = math.nextafter(edges[bin + 1], -math.inf)
        return Show((low, high), self.metric)

    # Texts

    @property
    def decimals(self) -> int:
        """Decimals that a hundredth of the axis needs."""
        return -math.floor(math.log10((self.high - self.low) / 100) + 1e-9)

    @property
    def exponent(self) -> int:
        """Power of ten in the title instead of in the ticks."""
        largest = max(abs(self.low), abs(self.high))
        return 0 if 1e-3 < largest < 1e5 else math.floor(math.log10(largest))

    @property
    def title(self) -> str:
        """Title of the metric with power of ten and unit."""
        metric = METRICS[self.metric]
        power = f"10{str(self.exponent).translate(_SUPERSCRIPT)}" if self.exponent else ""
        unit = " ".join(part for part in (power, metric.unit and tr(metric.unit)) if part)
        return f"{tr(metric.title)} [{unit}]" if unit else tr(metric.title)

    def ticks(self) -> list[tuple[float, str]]:
        """Return positions and texts of the ticks; at an end beyond which there are values, with ≤ or ≥."""
        scale = 10.0**self.exponent
        ticks = []
        for value in nice_ticks(self.low, self.high, _MAX_TICKS):
            text = range_label(value / scale, self.low / scale, self.high / scale).replace("-", "−")
            sign = "≤ " if self.below and value == self.low else "≥ " if self.above and value == self.high else ""
            ticks.append((self.position(value), sign + text))
        return ticks

    def text(self, value: float) -> str:
        """Write a value to a hundredth of the axis.

        >>> Axis("q").text(0.5), Axis("max-angle", 0, 180).text(90), Axis("volume", 0, 2e-5).text(1.25e-5)
        ('0.50', '90', '1.25e−05')
        """
        text = f"{value:.6g}" if not 0 <= self.decimals <= 4 else f"{value:.{self.decimals}f}"
        return text.replace("-", "−")


def _bulk(values: np.ndarray) -> tuple[float, float]:
    """Return a range with most of the values, which are ascending."""
    low, lower, upper, high = (values[round(share * (len(values) - 1))] for share in (0.005, 0.25, 0.75, 0.995))
    fence = 3 * (upper - lower)
    return max(low, lower - fence), min(high, upper + fence)


def _multiple(step: float, count: int) -> float:
    """Return a multiple of a step without its rounding error."""
    return round(count * step, 3 - math.floor(math.log10(step)))
