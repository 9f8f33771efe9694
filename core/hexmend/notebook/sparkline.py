"""Sparkline: a curve of the size of a word."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from html import escape

_WIDTH, _HEIGHT, _EDGE = 120, 24, 3
#: Points of a curve; more could not be distinguished.
_MAX_POINTS = 2 * _WIDTH


def sparkline(
    values: Sequence[float | int | None], title: str, marked: int | None = None, breaks: Sequence[int] = ()
) -> str:
    """Return an SVG curve of values with a dot at one of them; None and infinite values are gaps.

    Parameters
    ----------
    values : sequence of float or None
    title : str
        Tooltip, and text for screen readers.
    marked : int, optional
        Index of the value with the dot.
    breaks : sequence of int
        Ascending indices at which a new curve begins.

    Returns
    -------
    str
        Empty for fewer than two finite values.

    Examples
    --------
    >>> sparkline([1.0], "one")
    ''
    >>> sparkline([0.0, 0.5, 1.0], "rises").count("<polyline")
    1
    """
    known = [value for value in values if value is not None and math.isfinite(value)]
    if len(known) < 2:
        return ""
    low, span = min(known), (max(known) - min(known)) or 1.0
    across, up = (_WIDTH - 2 * _EDGE) / max(len(values) - 1, 1), _HEIGHT - 2 * _EDGE

    def place(at: int) -> str:
        return f"{_EDGE + across * at:.1f},{_HEIGHT - _EDGE - up * ((values[at] or 0.0) - low) / span:.1f}"

    lines: list[list[str]] = [[]]
    passed = 0
    for at in sorted({*range(0, len(values), math.ceil(len(values) / _MAX_POINTS)), len(values) - 1}):
        if bisect_right(breaks, at) > passed:
            passed = bisect_right(breaks, at)
            lines.append([])
        if values[at] is None or not math.isfinite(values[at]):
            lines.append([])
        else:
            lines[-1].append(place(at))
    drawn = "".join(f'<polyline points="{" ".join(line)}"/>' for line in lines if len(line) > 1)
    dot = ""
    if marked is not None and 0 <= marked < len(values) and values[marked] is not None:
        x, y = place(marked).split(",")
        dot = f'<circle cx="{x}" cy="{y}" r="2.5" fill="#0072b2" stroke="none"/>'
    return (
        f'<svg role="img" width="{_WIDTH}" height="{_HEIGHT}" viewBox="0 0 {_WIDTH} {_HEIGHT}" fill="none" '
        f'stroke="#0072b2" stroke-width="1.5"><title>{escape(title)}</title>{drawn}{dot}</svg>'
    )
