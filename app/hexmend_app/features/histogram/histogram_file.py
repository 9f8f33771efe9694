"""The histogram as a file: a figure, or its counts."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend.report.documents import write_text
from hexmend.report.histogram import Histogram, Outline
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import BINS, Distribution, distribute
from hexmend_app.state.mesh.metric_cache import metric_values

#: Kinds of file.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


@dataclass(frozen=True, eq=False)
class _Line:
    """A distribution as it is written."""

    name: str
    colour: str
    filled: bool
    part: Distribution


def write_histogram(
    path: str | Path,
    title: str,
    metric: str,
    drawn: Sequence[tuple[str, str, bool, Mesh]],
    *,
    bins: int = BINS,
    log: bool = False,
    cumulative: bool = False,
    style: ChartStyle | None = None,
) -> None:
    """Write how hexes are distributed, as SVG, PDF or PNG, or the counts as CSV, by the path's suffix.

    Parameters
    ----------
    path : path-like
    title : str
        Above the figure.
    metric : str
        A name of `hexmend.quality.METRICS`.
    drawn : sequence of (name, colour, filled, Mesh)
        What is drawn, at least one, in the order of the legend; the axis suits the first. Colours are #rrggbb.
    bins : int
    log : bool
        Heights by powers of ten.
    cumulative : bool
        Shares of hexes up to a value.
    style : ChartStyle, optional
        Sizes and names.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    style = ChartStyle() if style is None else style
    if suffix_for(Path(path), "a histogram", SUFFIXES) == ".csv":
        write_text(Path(path), _text(_counted(metric, drawn, bins, cumulative), cumulative, style.names))
    else:
        shown = figure(title, metric, drawn, bins=bins, log=log, cumulative=cumulative)
        write_chart(Path(path), shown.draw, style)


def figure(
    title: str,
    metric: str,
    drawn: Sequence[tuple[str, str, bool, Mesh]],
    *,
    bins: int = BINS,
    log: bool = False,
    cumulative: bool = False,
) -> Histogram:
    """The histogram, on white paper; see `write_histogram`."""
    lines = _counted(metric, drawn, bins, cumulative)
    axis, outlines = lines[0].part.axis, []
    for one in lines:
        part = one.part
        scale = 100 / max(part.total, 1) if cumulative else 1
        bars = ((axis.inverted, part.inverted), (axis.below, part.below), (axis.above, part.above))
        outlines.append(
            Outline(
                one.name,
                one.colour,
                [float(count * scale) for count in part.counts],
                [(*place, count * scale) for place, count in bars if place is not None and count],
                one.filled and not cumulative,
                f"{part.inverted:,} inverted",
            )
        )
    label = "% of hexes up to x, inverted first" if cumulative else "hexes"
    return Histogram(outlines, title, axis.title, label, axis.ticks(), axis.extent, log)


def _counted(metric: str, drawn: Sequence[tuple[str, str, bool, Mesh]], bins: int, cumulative: bool) -> list[_Line]:
    """The distributions, on the axis that suits the first."""
    axis, lines = None, []
    for name, colour, filled, mesh in drawn:
        figures = measure(mesh.points, mesh.hexes)
        known = metric_values(metric, mesh.points, mesh.hexes, figures)
        axis = axis or Axis.fitted(metric, known, figures.inverted)
        part = distribute(known, figures.inverted, axis, bins)
        lines.append(_Line(name, colour, filled, part.cumulated() if cumulative else part))
    return lines


def _text(lines: Sequence[_Line], cumulative: bool, names: Mapping[str, str]) -> str:
    """The counts, or the shares in percent, as CSV: a line a bin, inverted elements first; `names` as in a style."""
    parts, axis = [one.part for one in lines], lines[0].part.axis
    mark = "% of hexes up to: " if cumulative else ""
    rows: list[list] = [
        [f"{axis.metric} from", f"{axis.metric} to", *(mark + (names.get(one.name) or one.name) for one in lines)],
        ["inverted", "inverted", *(part.inverted for part in parts)],
    ]
    if axis.below is not None:
        rows.append(["-inf", f"{axis.low:.7g}", *(part.below for part in parts)])
    for at, ends in enumerate(pairwise(f"{edge:.7g}" for edge in parts[0].edges)):
        rows.append([*ends, *(int(part.counts[at]) for part in parts)])
    if axis.above is not None:
        rows.append([f"{axis.high:.7g}", "inf", *(part.above for part in parts)])
    if cumulative:
        for row in rows[1:]:
            row[2:] = [f"{100 * count / max(part.total, 1):.6g}" for count, part in zip(row[2:], parts, strict=True)]
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()
