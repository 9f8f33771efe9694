"""Texts of the histogram: the bin under the mouse and the range shown."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.features.histogram.outline import Series
from hexmend_app.picture.appearance import ValueRange
from hexmend_app.widgets.metric_texts import in_sentence
from hexmend_app.widgets.wording import counted


def describe(drawn: Sequence[Series], x: float, cumulative: bool) -> str:
    """The counts of the bin at x of the plot, or the shares up to it, of all that is drawn; "" beside the bins."""
    found = _bin_at(drawn[0].part, x, cumulative) if drawn else None
    if found is None:
        return ""
    title, count = found
    rows = [title]
    for one in drawn:
        number = count(one.part.cumulated() if cumulative else one.part)
        share = f"{100 * number / max(one.part.total, 1):.4g} %, " if cumulative else ""
        rows.append(f"{one.name}: {share}{counted(number, 'hex')}")
    return "\n".join(rows)


def _bin_at(part: Distribution, x: float, cumulative: bool) -> tuple[str, Callable[[Distribution], int]] | None:
    """Return the name of the bin at x, and a function that gets its count from a distribution."""
    axis = part.axis
    words = in_sentence(METRICS[axis.metric])
    low, high = axis.text(axis.low), axis.text(axis.high)
    for bar, title, count in (
        (axis.inverted, "inverted", lambda part: part.inverted),
        (axis.below, f"inverted, or {words} < {low}" if cumulative else f"{words} < {low}", lambda part: part.below),
        (axis.above, "all" if cumulative else f"{words} ≥ {high}", lambda part: part.above),
    ):
        if bar is not None and bar[0] <= x <= bar[1]:
            return title, count
    if not 0 <= x < 1:
        return None
    at = int(x * len(part.counts))
    low, high = _bin_texts(part, at)
    title = f"inverted, or {words} up to {high}" if cumulative else f"{words} {low} – {high}"
    return title, lambda part: int(part.counts[at])


def _bin_texts(part: Distribution, at: int) -> tuple[str, str]:
    """The ends of a bin, in as many digits as its width needs."""
    width = (part.axis.high - part.axis.low) / len(part.counts)
    ends = part.axis.low + width * at, part.axis.low + width * (at + 1)
    if not 0 <= part.axis.decimals <= 4:
        return tuple(part.axis.text(end) for end in ends)
    decimals = next((d for d in range(7) if abs(round(width, d) - width) < 0.05 * width), 7)
    return tuple(f"{end:.{decimals}f}" for end in ends)


def sentence(now: Distribution | None, chosen: ValueRange | None) -> str:
    """Return the text for the number of elements, or of those shown by a range of their metric."""
    if now is None:
        return "No mesh is open."
    if chosen is None:
        return f"{counted(now.total, 'hex')}, {now.inverted:,} inverted"
    return f"{now.within(chosen):,} of {counted(now.total, 'hex')}{_where(now, chosen)}"


def _where(now: Distribution, chosen: ValueRange) -> str:
    if chosen.high == -math.inf:
        return ", the inverted ones"
    values = _values(now.axis, chosen)
    if not now.inverted:
        return values
    if not values:
        return ", all but the inverted ones"
    return f"{values}, and the {now.inverted:,} inverted" if chosen.inverted else values


def _values(axis: Axis, chosen: ValueRange) -> str:
    """Return the text for the values a range bounds; "" if it bounds none."""
    least, most = METRICS[axis.metric].full_range
    low, high = axis.end(chosen.low), axis.end(chosen.high)
    unit = f" {METRICS[axis.metric].unit}".rstrip()
    if chosen.high >= most:
        return "" if chosen.low <= least else f" from {low}{unit}"
    return f" up to {high}{unit}" if chosen.low <= least else f" in {low} – {high}{unit}"
