"""Format of the values of a column, with one number of decimals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import floor, log10
from typing import Any

from hexmend.quantity import (
    Quantity,
    format_microseconds,
    format_milliseconds,
    format_objective,
    format_significant,
)

#: Factor of the values, and significant digits of the smallest one in a column, of formats with varying decimals.
_SCALES: dict[Callable[[Any], str], tuple[float, int]] = {
    format_significant: (1.0, 2),
    format_objective: (1.0, 7),
    format_milliseconds: (1e3, 2),
    format_microseconds: (1e6, 2),
}


def format_column(quantity: Quantity, records: Sequence[Mapping[str, Any]]) -> list[str]:
    """Format a column of values with one number of decimals; other texts are as `Quantity.of` has them.

    The smallest value gets two significant digits, or the digits in which two optima may differ, and at most four
    decimals.

    >>> time = Quantity("seconds", "time, s", "", format_significant)
    >>> format_column(time, [{"seconds": 0.0123}, {"seconds": 19.522}, {}])
    ['0.012', '19.522', '–']
    """
    scale, digits = _SCALES.get(quantity.text, (0.0, 0))
    values = [record.get(quantity.key) if scale else None for record in records]
    positive = [abs(value) * scale for value in values if value]
    if not positive:
        return [quantity.of(record) for record in records]
    decimals = min(max(digits - 1 - floor(log10(min(positive))), 0), 4)
    return ["–" if value is None else f"{value * scale:,.{decimals}f}" for value in values]
