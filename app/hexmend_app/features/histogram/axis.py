"""The axis of the histogram: which values the bins span, and where bars stand apart from them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.picture.appearance import ValueRange
from hexmend_app.scene.colour.colouring import range_label

#: Where on the plot the bins lie: from 0 to 1, whatever the metric.
_INVERTED = (-0.30, -0.18)
_BELOW, _ABOVE = (-0.06, -0.02), (1.02, 1.07)
_TICKS = 6


@dataclass(frozen=True)
class Axis:
    """Values from `low` to `high`, drawn from 0 to 1.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    low, high : float
    step : float
        Between two ticks.
    open_low, open_high : bool
        Whether values beyond the end are counted in a bar of their own.
    """

    metric: str
    low: float = 0.0
    high: float = 1.0
    step: float = 0.2
    open_low: bool = False
    open_high: bool = False

    @classmethod
    def fitted(cls, metric: str, values: np.ndarray, inverted: np.ndarray) -> Axis:
        """The axis of a metric for a mesh, which holds still while the mesh changes.

        Negative values belong to inverted elements, which stand apart. Where the metric has no other bound, the axis
        spans 99 % of the sound elements, but not beyond three times the distance of the quartiles from them, and is
        rounded outward to ticks.

        Parameters
        ----------
        metric : str
        values : (m,) float64
            At the start.
        inverted : (m,) bool

        Examples
        --------
        >>> Axis.fitted("aspect-ratio", np.linspace(1, 2.7, 50), np.zeros(50, bool))
        Axis(metric='aspect-ratio', low=1.0, high=2.8, step=0.3, open_low=False, open_high=True)
        """
        least, most = METRICS[metric].full_range
        least = max(least, 0.0)
        if math.isfinite(most):
            return cls(metric, least, most, _step(least, most))
        sound = values[np.isfinite(values) & ~inverted]
        low, high = _bulk(sound, least, METRICS[metric].acceptable[1])
        open_low = low - least > (high - least) / 2
        low, high, step = _rounded_outward(low if open_low else least, high, fixed=not open_low)
        return cls(metric, low, high, step, open_low, open_high=True)

    # Between values and places on the plot

    def place(self, value: float) -> float:
        """Return a value's position on the plot; beyond the ends, the outer side of the end bar."""
        if value < self.low:
            return (self.below or (0.0, 0.0))[0]
        if value > self.high:
            return (self.above or (1.0, 1.0))[1]
        return (value - self.low) / (self.high - self.low)

    def span(self, chosen: ValueRange) -> tuple[float, float]:
        """Left and right of a range on the plot; from the bar of inverted elements on, where nothing is left out."""
        least = METRICS[self.metric].full_range[0]
        joined = chosen.inverted and chosen.low <= least
        left = self.inverted[0] if joined else self.place(chosen.low)
        return left, self.inverted[1] if chosen.high == -math.inf else self.place(chosen.high)

    @property
    def decimals(self) -> int:
        """Digits after the point that a hundredth of the axis needs."""
        return -math.floor(math.log10((self.high - self.low) / 100) + 1e-9)

    @property
    def grain(self) -> float:
        """A hundredth of the axis, by which its numbers are stepped."""
        return 10.0**-self.decimals

    @property
    def inverted(self) -> tuple[float, float]:
        """Left and right of the bar of inverted elements."""
        shift = _BELOW[0] if self.open_low else 0.0
        return _INVERTED[0] + shift, _INVERTED[1] + shift

    @property
    def below(self) -> tuple[float, float] | None:
        """Left and right of the bar of values below the axis; None where there are none."""
        return _BELOW if self.open_low else None

    @property
    def above(self) -> tuple[float, float] | None:
        """Left and right of the bar of values above the axis; None where there are none."""
        return _ABOVE if self.open_high else None

    @property
    def reach(self) -> tuple[float, float]:
        """Return the limits of a brushed range: everything that is counted."""
        return self.inverted[0], (self.above or (1.0, 1.0))[1]

    @property
    def extent(self) -> tuple[float, float]:
        """Left and right of the plot."""
        return self.inverted[0] - 0.10, 1.11 if self.open_high else 1.06

    # In words

    @property
    def exponent(self) -> int:
        """The power of ten that ticks leave to the title."""
        size = max(abs(self.low), abs(self.high))
        return 0 if 1e-3 < size < 1e5 else math.floor(math.log10(size))

    @property
    def title(self) -> str:
        """The metric with its unit, as it stands below the plot."""
        metric = METRICS[self.metric]
        power = f"10{str(self.exponent).translate(_SUPERSCRIPT)}" if self.exponent else ""
        unit = " ".join(part for part in (power, metric.unit) if part)
        return f"{metric.title} [{unit}]" if unit else metric.title

    def ticks(self) -> list[tuple[float, str]]:
        """Places and texts below the plot, those of the bars that stand apart first."""
        marks = [(sum(self.inverted) / 2, "inverted")]
        for bar, sign, end in ((self.below, "<", self.low), (self.above, "≥", self.high)):
            if bar is not None:
                marks.append((sum(bar) / 2, f"{sign} {self._tick(end)}"))
        for k in range(round((self.high - self.low) / self.step) + 1):
            value = self.low + k * self.step
            if not (k == 0 and self.open_low) and not (value > self.high - self.step / 2 and self.open_high):
                marks.append((self.place(min(value, self.high)), self._tick(value)))
        return marks

    def _tick(self, value: float) -> str:
        scale = 10.0**self.exponent
        return range_label(value / scale, self.low / scale, self.high / scale)

    def text(self, value: float) -> str:
        """A value to a hundredth of the axis.

        >>> Axis("q").text(0.5), Axis("max-angle", 0, 180).text(90), Axis("volume", 0, 2e-5).text(1.25e-5)
        ('0.50', '90', '1.25e-05')
        """
        if math.isinf(value):
            return "∞" if value > 0 else "−∞"
        return f"{value:.6g}" if not 0 <= self.decimals <= 4 else f"{value:.{self.decimals}f}"

    def end(self, value: float) -> str:
        """An end of a range, with two more digits where it needs them.

        >>> Axis("q").end(0.505), Axis("q").end(0.49999999999999994)
        ('0.505', '0.50')
        """
        if not (math.isfinite(value) and 0 <= self.decimals <= 4):
            return self.text(value)
        whole, _, digits = f"{value:.{self.decimals + 2}f}".partition(".")
        digits = digits[: self.decimals] + digits[self.decimals :].rstrip("0")
        return f"{whole}.{digits}" if digits else whole


_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _bulk(sound: np.ndarray, least: float, acceptable: float) -> tuple[float, float]:
    """From where to where most values lie; never nothing."""
    if not sound.size:
        return least, acceptable if math.isfinite(acceptable) else least + 1.0
    low, lower, upper, high = (float(v) for v in np.percentile(sound, (0.5, 25, 75, 99.5)))
    fence = 3 * (upper - lower)
    low = max(low, lower - fence, least)
    high = max(min(high, upper + fence), low)
    if high - low <= 1e-6 * abs(high):
        low, high = max(low / 2, least), 1.5 * high or (acceptable if math.isfinite(acceptable) else 1.0)
    return low, high


def _steps(span: float) -> list[float]:
    """Round numbers upwards from a tenth of a span."""
    power = math.floor(math.log10(span) - 1)
    return [float(f"{m}e{p}") for p in (power, power + 1) for m in (1, 1.5, 2, 2.5, 3, 4, 5)]


def _step(low: float, high: float) -> float:
    """The finest round step that divides a span into few parts."""
    span = high - low
    whole = [s for s in _steps(span) if span / s <= _TICKS + 1e-9 and abs(span / s - round(span / s)) < 1e-9]
    return whole[0] if whole else span / 5


def _rounded_outward(low: float, high: float, fixed: bool) -> tuple[float, float, float]:
    """Ends that are a few round steps apart, and the step; a `fixed` low end stays."""
    for step in _steps(high - low):
        first = low if fixed else math.floor(low / step + 1e-9) * step
        count = math.ceil((high - first) / step - 1e-9)
        if count <= _TICKS:
            return _clean(first, step), _clean(first + count * step, step), step
    raise ValueError(f"there is no axis from {low} to {high}")


def _clean(value: float, step: float) -> float:
    """Without the rounding errors of adding steps up."""
    return round(value, 3 - math.floor(math.log10(step)))
