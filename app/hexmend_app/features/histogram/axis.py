"""Axis of the histogram: range of the bins, positions of the separate bars, ticks and texts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.colour.colouring import range_label
from hexmend_app.scene.colour.ticks import nice_ticks
from hexmend_app.translation import tr

#: Left and right ends of the separate bars on the plot, on which the bins span 0 to 1.
_INVERTED = (-0.30, -0.18)
_BELOW, _ABOVE = (-0.06, -0.02), (1.02, 1.07)
_MAX_TICKS = 7


@dataclass(frozen=True)
class Axis:
    """Axis of a metric, with values from `low` to `high` at the positions 0 to 1 of the plot.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    low, high : float
    open_low, open_high : bool
        True if values beyond the end are counted in a separate bar.
    """

    metric: str
    low: float = 0.0
    high: float = 1.0
    open_low: bool = False
    open_high: bool = False

    @classmethod
    def fitted(cls, metric: str, values: np.ndarray, inverted: np.ndarray) -> Axis:
        """Return the axis of a metric for a mesh; it stays the same while the mesh changes.

        The axis begins at 0 or higher: inverted hexes, which may have negative values, have a separate bar. If the
        metric is unbounded, the axis spans 99 % of the valid hexes, but at most three interquartile ranges beyond the
        quartiles, rounded outward to ticks.

        Parameters
        ----------
        metric : str
        values : (m,) float64
            Values of all hexes at the start.
        inverted : (m,) bool

        Examples
        --------
        >>> Axis.fitted("aspect-ratio", np.linspace(1, 2.7, 50), np.zeros(50, bool))
        Axis(metric='aspect-ratio', low=1.0, high=2.75, open_low=False, open_high=True)
        """
        minimum, maximum = METRICS[metric].full_range
        minimum = max(minimum, 0.0)
        if math.isfinite(maximum):
            return cls(metric, minimum, maximum)
        valid = values[np.isfinite(values) & ~inverted]
        low, high = _bulk(valid, minimum, METRICS[metric].acceptable[1])
        open_low = low - minimum > (high - minimum) / 2
        ticks = nice_ticks(low if open_low else minimum, high, _MAX_TICKS)
        step = ticks[1] - ticks[0]
        low = _multiple(step, math.floor(low / step + 1e-9)) if open_low else minimum
        return cls(metric, low, _multiple(step, math.ceil(high / step - 1e-9)), open_low, open_high=True)

    # Positions on the plot

    def position(self, value: float) -> float:
        """Return the position of a value on the plot; beyond the ends, the outer side of the end bar."""
        if value < self.low:
            return (self.below or (0.0, 0.0))[0]
        if value > self.high:
            return (self.above or (1.0, 1.0))[1]
        return (value - self.low) / (self.high - self.low)

    def span(self, range: Show) -> tuple[float, float]:
        """Return left and right end of a range on the plot, with the bar of inverted hexes if it adjoins the range."""
        joined = range.inverted and range.low <= METRICS[self.metric].full_range[0]
        left = self.inverted[0] if joined else self.position(range.low)
        return left, self.inverted[1] if range.high == -math.inf else self.position(range.high)

    @property
    def inverted(self) -> tuple[float, float]:
        """Left and right end of the bar of inverted hexes."""
        shift = _BELOW[0] if self.open_low else 0.0
        return _INVERTED[0] + shift, _INVERTED[1] + shift

    @property
    def below(self) -> tuple[float, float] | None:
        """Left and right end of the bar of values below the axis; None without this bar."""
        return _BELOW if self.open_low else None

    @property
    def above(self) -> tuple[float, float] | None:
        """Left and right end of the bar of values above the axis; None without this bar."""
        return _ABOVE if self.open_high else None

    @property
    def brush_limits(self) -> tuple[float, float]:
        """Left and right limit of a brushed range, which includes all bars."""
        return self.inverted[0], (self.above or (1.0, 1.0))[1]

    @property
    def extent(self) -> tuple[float, float]:
        """Left and right end of the plot."""
        return self.inverted[0] - 0.10, 1.11 if self.open_high else 1.06

    # Texts

    @property
    def decimals(self) -> int:
        """Decimals that a hundredth of the axis needs."""
        return -math.floor(math.log10((self.high - self.low) / 100) + 1e-9)

    @property
    def resolution(self) -> float:
        """About a hundredth of the axis, the step of its numbers."""
        return 10.0**-self.decimals

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
        """Return positions and texts of the ticks; the separate bars come first."""
        ticks = [(sum(self.inverted) / 2, tr("inverted"))]
        for bar, sign, end in ((self.below, "<", self.low), (self.above, "≥", self.high)):
            if bar is not None:
                ticks.append((sum(bar) / 2, f"{sign} {self._tick_text(end)}"))
        values = nice_ticks(self.low, self.high, _MAX_TICKS)
        inside = [v for v in values if (v > self.low or not self.open_low) and (v < self.high or not self.open_high)]
        return ticks + [(self.position(value), self._tick_text(value)) for value in inside]

    def _tick_text(self, value: float) -> str:
        scale = 10.0**self.exponent
        return range_label(value / scale, self.low / scale, self.high / scale).replace("-", "−")

    def text(self, value: float) -> str:
        """Write a value to a hundredth of the axis.

        >>> Axis("q").text(0.5), Axis("max-angle", 0, 180).text(90), Axis("volume", 0, 2e-5).text(1.25e-5)
        ('0.50', '90', '1.25e-05')
        """
        if math.isinf(value):
            return "∞" if value > 0 else "−∞"
        return f"{value:.6g}" if not 0 <= self.decimals <= 4 else f"{value:.{self.decimals}f}"

    def end_text(self, value: float) -> str:
        """Write an end of a range, with up to two more decimals than `text`.

        >>> Axis("q").end_text(0.505), Axis("q").end_text(0.49999999999999994)
        ('0.505', '0.50')
        """
        if not (math.isfinite(value) and 0 <= self.decimals <= 4):
            return self.text(value)
        whole, _, digits = f"{value:.{self.decimals + 2}f}".partition(".")
        digits = digits[: self.decimals] + digits[self.decimals :].rstrip("0")
        return f"{whole}.{digits}" if digits else whole


_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _bulk(valid: np.ndarray, minimum: float, acceptable: float) -> tuple[float, float]:
    """Return a range, never empty, with most of the values, and not below `minimum`."""
    if not valid.size:
        return minimum, acceptable if math.isfinite(acceptable) else minimum + 1.0
    low, lower, upper, high = (float(v) for v in np.percentile(valid, (0.5, 25, 75, 99.5)))
    fence = 3 * (upper - lower)
    low = max(low, lower - fence, minimum)
    high = max(min(high, upper + fence), low)
    if high - low <= 1e-6 * abs(high):
        low, high = max(low / 2, minimum), 1.5 * high or (acceptable if math.isfinite(acceptable) else 1.0)
    return low, high


def _multiple(step: float, count: int) -> float:
    """Return a multiple of a step without its rounding error."""
    return round(count * step, 3 - math.floor(math.log10(step)))
