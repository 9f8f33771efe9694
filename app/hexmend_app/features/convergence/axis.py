"""Range and ticks of a chart's vertical axis, rounded so that they change seldom during a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend_app.scene.colour.ticks import nice_ticks


@dataclass(frozen=True)
class Scale:
    """Range and ticks of an axis.

    Parameters
    ----------
    low, high : float
        Ends of the axis; decimal logarithms if it is logarithmic.
    ticks : tuple of (position, text)
    floor : float, optional
        Position of zero on a logarithmic axis; None if no value is zero.
    """

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]
    floor: float | None = None


#: The axis of quality, without and with negative scaled Jacobians.
_UNIT = Scale(0.0, 1.0, ((0.0, "0"), (0.5, "0.5"), (1.0, "1")))
_SIGNED = Scale(-1.0, 1.0, ((-1.0, "−1"), (0.0, "0"), (1.0, "1")))


def unit_scale(values: np.ndarray) -> Scale:
    """Return the axis of quality from 0 to 1, or from -1 if any of the values, (k,) float64, is negative."""
    return _SIGNED if values.min(initial=0.0) < 0 else _UNIT


def linear_scale(values: np.ndarray, whole: bool) -> Scale:
    """Return a linear axis from 0 for values, (k,) float64 without nan; `whole` allows only integer ticks.

    >>> linear_scale(np.array([0.0, 4.2]), whole=False)
    Scale(low=0.0, high=5.0, ticks=((0.0, '0'), (2.0, '2'), (4.0, '4')), floor=None)
    """
    high = _round_up(float(values.max(initial=0.0)) or 1.0)
    ticks = [tick for tick in nice_ticks(0, high, 3) if not whole or tick == round(tick)]
    return Scale(0.0, high, tuple((tick, f"{tick:,.4g}") for tick in ticks))


def log_scale(values: np.ndarray, whole: bool) -> Scale:
    """Return a logarithmic axis for values, (k,) float64 without nan, with a position for zero if it is among them.

    >>> log_scale(np.array([1000.0, 20.0, 0.0]), whole=True)
    Scale(low=-1.0, high=3.0, ticks=((3.0, '1,000'), (1.0, '10'), (-1.0, '0')), floor=-1.0)
    """
    positive = values[values > 0]
    low, high = (math.floor(math.log10(positive.min())), math.log10(positive.max())) if positive.size else (0, 1)
    high = float(max(math.ceil(4 * high) / 4, low + 1))
    floor = float((0 if whole else low) - 1) if (values <= 0).any() else None
    step = max(1, -(-(math.floor(high) - low + (floor is not None)) // 2))
    ticks = [(float(k), _power(k)) for k in range(math.floor(high), low - 1, -step)]
    if floor is None:
        return Scale(float(low), high, tuple(ticks))
    spaced = [tick for tick in ticks if tick[0] - floor > 0.2 * (high - floor)]
    return Scale(floor, high, (*spaced, (floor, "0")), floor)


def _round_up(value: float) -> float:
    """Round up to 1, 1.5, 2, 3, 5, 7 or 10 times a power of ten.

    >>> _round_up(0.8), _round_up(1.2), _round_up(640)
    (1.0, 1.5, 700.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(m * power for m in (1, 1.5, 2, 3, 5, 7, 10) if m * power >= value * (1 - 1e-9))


def _power(exponent: int) -> str:
    """Format a power of ten.

    >>> _power(3), _power(-1), _power(-7)
    ('1,000', '0.1', '1e−7')
    """
    return f"{10.0**exponent:,g}" if -3 <= exponent <= 4 else f"1e{exponent}".replace("-", "−")
