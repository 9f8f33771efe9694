"""Range of a chart's axis, rounded to steps so that it seldom changes during a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend_app.scene.colour.ticks import nice_ticks


@dataclass(frozen=True)
class Scale:
    """An axis.

    Parameters
    ----------
    low, high : float
        Its ends, as drawn.
    ticks : tuple of (place, text)
    floor : float, optional
        Where zero is drawn below powers of ten; None where there is none.
    """

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]
    floor: float | None = None


#: The axis of quality.
UNIT = Scale(0.0, 1.0, ((0.0, "0"), (0.5, "0.5"), (1.0, "1")))


def simple(known: np.ndarray, whole: bool) -> Scale:
    """From zero to beyond the greatest of some values, (k,) float64 without nan; `whole` numbers or not.

    >>> simple(np.array([0.0, 4.2]), whole=False)
    Scale(low=0.0, high=5.0, ticks=((0.0, '0'), (2.0, '2'), (4.0, '4')), floor=None)
    """
    high = _round_up(float(known.max(initial=0.0)) or 1.0)
    ticks = [tick for tick in nice_ticks(0, high, 3) if not whole or tick == round(tick)]
    return Scale(0.0, high, tuple((tick, f"{tick:,.4g}") for tick in ticks))


def powers(known: np.ndarray, whole: bool) -> Scale:
    """By powers of ten around some values, (k,) float64 without nan, with a place for zero where it is among them.

    >>> powers(np.array([1000.0, 20.0, 0.0]), whole=True)
    Scale(low=-1.0, high=3.0, ticks=((3.0, '1,000'), (1.0, '10'), (-1.0, '0')), floor=-1.0)
    """
    above = known[known > 0]
    low, high = (math.floor(math.log10(above.min())), math.log10(above.max())) if above.size else (0, 1)
    high = float(max(math.ceil(4 * high) / 4, low + 1))
    floor = float((0 if whole else low) - 1) if (known <= 0).any() else None
    step = max(1, -(-(math.floor(high) - low + (floor is not None)) // 2))
    ticks = [(float(k), _power(k)) for k in range(math.floor(high), low - 1, -step)]
    if floor is None:
        return Scale(float(low), high, tuple(ticks))
    special = [tick for tick in ticks if tick[0] - floor > 0.2 * (high - floor)]
    return Scale(floor, high, (*special, (floor, "0")), floor)


def _round_up(value: float) -> float:
    """1, 1.5, 2, 3, 5 or 7 times a power of ten, at least `value`.

    >>> _round_up(0.8), _round_up(1.2), _round_up(640)
    (1.0, 1.5, 700.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(m * power for m in (1, 1.5, 2, 3, 5, 7, 10) if m * power >= value * (1 - 1e-9))


def _power(exponent: int) -> str:
    """A power of ten as it is read most easily.

    >>> _power(3), _power(-1), _power(-7)
    ('1,000', '0.1', '1e−7')
    """
    return f"{10.0**exponent:,g}" if -3 <= exponent <= 4 else f"1e{exponent}".replace("-", "−")
