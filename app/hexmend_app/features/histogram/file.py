"""The histogram as a file: a figure, or its counts."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

from hexmend.io.suffixes import suffix_for
from hexmend.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend.report.documents import write_text
from hexmend.report.histogram import Histogram, Outline
from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.features.histogram.panel import QualityHistogram

#: Kinds of file.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


def write_histogram(path: Path, panel: QualityHistogram, title: str, style: ChartStyle | None = None) -> None:
    """Write a histogram as it is drawn, as SVG, PDF or PNG, or its counts as CSV, by the path's suffix.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    style = ChartStyle() if style is None else style
    if suffix_for(path, "a histogram", SUFFIXES) == ".csv":
        write_text(path, text(panel, style.names))
    else:
        write_chart(path, figure(panel, title).draw, style)


def figure(panel: QualityHistogram, title: str) -> Histogram:
    """The histogram as it is drawn, on white paper."""
    axis, cumulative = panel.axis, panel.cumulative
    outlines = []
    for one in panel.series():
        part = _as_drawn(one.part, cumulative)
        scale = 100 / max(part.total, 1) if cumulative else 1
        bars = ((axis.inverted, part.inverted), (axis.below, part.below), (axis.above, part.above))
        outlines.append(
            Outline(
                one.name,
                one.colour.of(dark=False),
                [float(count * scale) for count in part.counts],
                [(*place, count * scale) for place, count in bars if place is not None and count],
                one.filled and not cumulative,
                f"{part.inverted:,} inverted",
            )
        )
    label = "% of hexes up to x, inverted first" if cumulative else "hexes"
    return Histogram(outlines, title, axis.title, label, axis.ticks(), axis.extent, panel.log)


def text(histogram: QualityHistogram, names: Mapping[str, str] | None = None) -> str:
    """The counts, or the shares in percent, as CSV: a line a bin, the inverted elements first.

    `names` are what distributions are called, by what they call themselves.
    """
    names = names or {}
    drawn, axis, cumulative = histogram.series(), histogram.axis, histogram.cumulative
    parts = [_as_drawn(one.part, cumulative) for one in drawn]
    mark = "% of hexes up to: " if cumulative else ""
    rows: list[list] = [
        [
            f"{axis.metric} from",
            f"{axis.metric} to",
            *(mark + (names.get(one.name) or one.name) for one in drawn),
        ],
        ["inverted", "inverted", *(part.inverted for part in parts)],
    ]
    if axis.below is not None:
        rows.append(["-inf", f"{axis.low:.7g}", *(part.below for part in parts)])
    edges = [f"{edge:.7g}" for edge in parts[0].edges] if parts else []
    for at, ends in enumerate(pairwise(edges)):
        rows.append([*ends, *(int(part.counts[at]) for part in parts)])
    if axis.above is not None:
        rows.append([f"{axis.high:.7g}", "inf", *(part.above for part in parts)])
    if cumulative:
        for row in rows[1:]:
            row[2:] = [f"{100 * count / max(part.total, 1):.6g}" for count, part in zip(row[2:], parts, strict=True)]
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


def _as_drawn(part: Distribution, cumulative: bool) -> Distribution:
    return part.cumulated() if cumulative else part
