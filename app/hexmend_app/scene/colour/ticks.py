"""Tick values along a scale."""

from __future__ import annotations

import math


def nice_ticks(low: float, high: float, most: int) -> list[float]:
    """Return at most `most` multiples of 1, 2, 2.5 or 5 times a power of ten in [low, high].

    >>> nice_ticks(0, 1, 6)
    [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
    >>> nice_ticks(0.31, 0.44, 4)
    [0.35, 0.4]
    >>> nice_ticks(0, 1e-9, 5)
    [0.0, 2.5e-10, 5e-10, 7.5e-10, 1e-09]
    """
    if not high > low or most < 1:
        return []
    power = math.floor(math.log10((high - low) / most))
    for step in (round(m * 10.0**e, 12 - e) for e in (power, power + 1, power + 2) for m in (1, 2, 2.5, 5)):
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last - first + 1 <= most:
            return [round(k * step, 12 - power) for k in range(first, last + 1)]
    return []


def ticks_with_ends(low: float, high: float, space: float, most: int) -> list[float]:
    """Return both ends, and round values between them that are far enough apart.

    Parameters
    ----------
    low, high : float
    space : float
        Minimum distance of values, as a fraction of the scale.
    most : int
        Maximum number of values, including both ends.
    """
    if not high > low:
        return []
    gap = space * (high - low)
    between: list[float] = []
    for count in range(min(int(1 / space) + 1, most), 2, -1):
        between = nice_ticks(low, high, count)
        if len(between) < 2 or between[1] - between[0] >= gap:
            break
    return [low, *(tick for tick in between if low + gap <= tick <= high - gap), high]
