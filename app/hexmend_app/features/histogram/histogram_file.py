"""Export of the histogram as a picture, or of its counts as CSV."""

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
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import DEFAULT_BINS, Distribution, distribute
from hexmend_app.report.histogram import Histogram, Outline
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.translation import tr

#: Suffixes of the files that can be written.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


@dataclass(frozen=True, eq=False)
class _Line:
    """A distribution with its name and style."""

    name: str
    colour: str
    filled: bool
    distribution: Distribution


def write_histogram(
    path: str | Path,
    title: str,
    metric: str,
    drawn: Sequence[tuple[str, str, bool, Mesh]],
    *,
    bins: int = DEFAULT_BINS,
    log: bool = False,
    cumulative: bool = False,
    style: ChartStyle | None = None,
) -> None:
    """Write the histogram as SVG, PDF or PNG, or its counts as CSV, by the suffix.

    Parameters
    ----------
    path : path-like
    title : str
        Title above the figure.
    metric : str
        A name of `hexmend.quality.METRICS`.
    drawn : sequence of (name, colour, filled, Mesh)
        Meshes, at least one, in the order of the legend; the axis fits the first. Colours are #rrggbb.
    bins : int
        Number of bins.
    log : bool
        Draw logarithmic heights.
    cumulative : bool
        Write shares of hexes up to a value instead of counts.
    style : ChartStyle, optional
        Sizes and names.

    Raises
    ------
    HexmendError
        If the suffix is unknown or the file cannot be written; an existing file is left unchanged.
    """
    style = ChartStyle() if style is None else style
    if suffix_for(Path(path), "a histogram", SUFFIXES) == ".csv":
        write_text(Path(path), _csv_text(_count(metric, drawn, bins, cumulative), cumulative, style.names))
    else:
        chart = figure(title, metric, drawn, bins=bins, log=log, cumulative=cumulative)
        write_chart(Path(path), chart.draw, style)


def figure(
    title: str,
    metric: str,
    drawn: Sequence[tuple[str, str, bool, Mesh]],
    *,
    bins: int = DEFAULT_BINS,
    log: bool = False,
    cumulative: bool = False,
) -> Histogram:
    """Return the histogram as a figure for print; see `write_histogram`."""
    lines = _count(metric, drawn, bins, cumulative)
    axis, outlines = lines[0].distribution.axis, []
    for line in lines:
        counted = line.distribution
        scale = 100 / max(counted.total, 1) if cumulative else 1
        bars = ((axis.inverted, counted.inverted), (axis.below, counted.below), (axis.above, counted.above))
        outlines.append(
            Outline(
                line.name,
                line.colour,
                [float(count * scale) for count in counted.counts],
                [(*span, count * scale) for span, count in bars if span is not None and count],
                line.filled and not cumulative,
                tr("{count:,} inverted", count=counted.inverted),
            )
        )
    label = tr("% of hexes up to x, inverted first") if cumulative else tr("hexes")
    return Histogram(outlines, title, axis.title, label, axis.ticks(), axis.extent, log)


def _count(metric: str, drawn: Sequence[tuple[str, str, bool, Mesh]], bins: int, cumulative: bool) -> list[_Line]:
    """Count the hexes of the meshes on the axis that fits the first."""
    axis, lines = None, []
    for name, colour, filled, mesh in drawn:
        figures = measure(mesh.points, mesh.hexes, mesh.mid_nodes)
        values = metric_values(metric, mesh, figures)
        axis = axis or Axis.fitted(metric, values, figures.inverted)
        distribution = distribute(values, figures.inverted, axis, bins)
        lines.append(_Line(name, colour, filled, distribution.cumulated() if cumulative else distribution))
    return lines


def _csv_text(lines: Sequence[_Line], cumulative: bool, names: Mapping[str, str]) -> str:
    """Write counts, or shares in percent, as CSV with a row per bar or bin; `names` replaces names of lines."""
    columns, axis = [line.distribution for line in lines], lines[0].distribution.axis
    prefix = tr("% of hexes up to: ") if cumulative else ""
    titles = [prefix + (names.get(line.name) or line.name) for line in lines]
    rows: list[list] = [
        [f"{axis.metric} from", f"{axis.metric} to", *titles],
        ["inverted", "inverted", *(column.inverted for column in columns)],
    ]
    if axis.below is not None:
        rows.append(["-inf", f"{axis.low:.7g}", *(column.below for column in columns)])
    for index, ends in enumerate(pairwise(f"{edge:.7g}" for edge in columns[0].edges)):
        rows.append([*ends, *(int(column.counts[index]) for column in columns)])
    if axis.above is not None:
        rows.append([f"{axis.high:.7g}", "inf", *(column.above for column in columns)])
    if cumulative:
        for row in rows[1:]:
            row[2:] = [
                f"{100 * count / max(column.total, 1):.6g}" for count, column in zip(row[2:], columns, strict=True)
            ]
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()
