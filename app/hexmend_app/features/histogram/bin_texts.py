"""Texts of the histogram: tooltip of a bin and summary of the range."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.features.histogram.outline import Series
from hexmend_app.picture.visibility import Show
from hexmend_app.translation import tr
from hexmend_app.widgets.metric_texts import in_sentence
from hexmend_app.widgets.wording import counted


def describe_bin(series: Sequence[Series], x: float, cumulative: bool) -> str:
    """Describe the bin or bar at a position of the plot.

    Parameters
    ----------
    series : sequence of Series
    x : float
        Position on the plot, on which the bins span 0 to 1.
    cumulative : bool
        Give the shares up to the end of the bin instead of its counts.

    Returns
    -------
    str
        A line with the range of values, and a line for each series; "" if there is no bin at `x`.
    """
    found = _bin_at(series[0].distribution, x, cumulative) if series else None
    if found is None:
        return ""
    title, count = found
    lines = [title]
    for one in series:
        number = count(one.distribution.cumulated() if cumulative else one.distribution)
        share = f"{100 * number / max(one.distribution.total, 1):.4g} %, " if cumulative else ""
        lines.append(f"{one.name}: {share}{counted(number, 'hex')}")
    return "\n".join(lines)


def _bin_at(shown: Distribution, x: float, cumulative: bool) -> tuple[str, Callable[[Distribution], int]] | None:
    """Return the title of the bin at x, and a function that gets its count from a distribution."""
    axis = shown.axis
    metric = in_sentence(METRICS[axis.metric])
    low, high = axis.text(axis.low), axis.text(axis.high)
    below = tr("inverted, or {metric} < {low}", metric=metric, low=low) if cumulative else f"{metric} < {low}"
    for bar, title, count in (
        (axis.inverted, tr("inverted"), lambda distribution: distribution.inverted),
        (axis.below, below, lambda distribution: distribution.below),
        (axis.above, tr("all") if cumulative else f"{metric} ≥ {high}", lambda distribution: distribution.above),
    ):
        if bar is not None and bar[0] <= x <= bar[1]:
            return title, count
    if not 0 <= x < 1:
        return None
    index = int(x * len(shown.counts))
    low, high = _bin_ends(shown, index)
    title = (
        tr("inverted, or {metric} up to {high}", metric=metric, high=high) if cumulative else f"{metric} {low} – {high}"
    )
    return title, lambda distribution: int(distribution.counts[index])


def _bin_ends(shown: Distribution, index: int) -> tuple[str, str]:
    """Write the ends of a bin with as many decimals as its width needs."""
    axis = shown.axis
    width = (axis.high - axis.low) / len(shown.counts)
    low, high = axis.low + width * index, axis.low + width * (index + 1)
    if not 0 <= axis.decimals <= 4:
        return axis.text(low), axis.text(high)
    decimals = next((d for d in range(7) if abs(round(width, d) - width) < 0.05 * width), 7)
    return f"{low:.{decimals}f}", f"{high:.{decimals}f}"


def range_summary(now: Distribution | None, range: Show | None, inside: int) -> str:
    """Describe the number of hexes in a range of their metric, or of all hexes, and of invalid ones, if it is None."""
    if now is None:
        return tr("No mesh is open.")
    if range is None:
        counts = {"hexes": counted(now.total, "hex"), "inverted": now.inverted, "inside": inside}
        if inside:
            return tr("{hexes}, {inverted:,} inverted · {inside:,} invalid inside", **counts)
        return tr("{hexes}, {inverted:,} inverted", **counts)
    hexes, description = counted(now.total, "hex"), _description(now, range)
    return tr("{count:,} of {hexes}{description}", count=now.within(range), hexes=hexes, description=description)


def _description(now: Distribution, range: Show) -> str:
    if range.high == -math.inf:
        return tr(", inverted only")
    values = _values(now.axis, range)
    if not now.inverted:
        return values
    if not values:
        return tr(", inverted hidden")
    return (
        tr("{values}, and the {inverted:,} inverted", values=values, inverted=now.inverted)
        if range.inverted
        else values
    )


def _values(axis: Axis, range: Show) -> str:
    """Describe the bounds of a range; "" if it has none."""
    minimum, maximum = METRICS[axis.metric].full_range
    low, high = axis.end_text(range.low), axis.end_text(range.high)
    unit = METRICS[axis.metric].unit
    unit = f" {tr(unit)}" if unit else ""
    if range.high >= maximum:
        return "" if range.low <= minimum else tr(" from {low}{unit}", low=low, unit=unit)
    if range.low <= minimum:
        return tr(" up to {high}{unit}", high=high, unit=unit)
    return tr(" from {low} to {high}{unit}", low=low, high=high, unit=unit)
