"""Export of the histogram as a picture, or of its counts as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.report.documents import write_text
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import DEFAULT_BINS, Distribution, distribute
from hexmend_app.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend_app.report.histogram import Histogram, Outline
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.translation import tr

#: Suffixes of the files that can be written.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


@dataclass(frozen=True)
class HistogramExport:
    """Histogram to be exported.

    Parameters
    ----------
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
    """

    title: str
    metric: str
    drawn: Sequence[tuple[str, str, bool, Mesh]]
    bins: int = DEFAULT_BINS
    log: bool = False
    cumulative: bool = False

    def write(self, path: str | Path, style: ChartStyle | None = None) -> None:
        """Write the histogram as SVG, PDF or PNG, or its counts as CSV, by the suffix.

        Raises
        ------
        HexmendError
            If the suffix is unknown or the file cannot be written; an existing file is left unchanged.
        """
        style = ChartStyle() if style is None else style
        if suffix_for(Path(path), "a histogram", SUFFIXES) == ".csv":
            names = [style.names.get(name) or name for name, *_ in self.drawn]
            write_text(Path(path), _csv_text(self._count(), names, self.cumulative))
        else:
            write_chart(Path(path), self.figure().draw, style)

    def figure(self) -> Histogram:
        """Return the histogram as a figure for print."""
        columns = self._count()
        axis, outlines = columns[0].axis, []
        for (name, colour, filled, _), counted in zip(self.drawn, columns, strict=True):
            scale = 100 / max(counted.total, 1) if self.cumulative else 1
            bars = ((axis.inverted, counted.inverted), (axis.below, counted.below), (axis.above, counted.above))
            outlines.append(
                Outline(
                    name,
                    colour,
                    [float(count * scale) for count in counted.counts],
                    [(*span, count * scale) for span, count in bars if span is not None and count],
                    filled and not self.cumulative,
                    tr("{count:,} inverted", count=counted.inverted),
                )
            )
        label = tr("% of hexes up to x, inverted first") if self.cumulative else tr("hexes")
        return Histogram(outlines, self.title, axis.title, label, axis.ticks(), axis.extent, self.log)

    def _count(self) -> list[Distribution]:
        """Count the hexes of the meshes on the axis that fits the first."""
        axis, columns = None, []
        for *_, mesh in self.drawn:
            figures = measure(mesh.points, mesh.hexes, mesh.mid_nodes)
            values = metric_values(self.metric, mesh, figures)
            axis = axis or Axis.fitted(self.metric, values, figures.inverted)
            distribution = distribute(values, figures.inverted, axis, self.bins)
            columns.append(distribution.cumulated() if self.cumulative else distribution)
        return columns


def _csv_text(columns: Sequence[Distribution], names: Sequence[str], cumulative: bool) -> str:
    """Write counts, or shares in percent, as CSV with a row per bar or bin, and a column per distribution."""
    axis = columns[0].axis
    prefix = tr("% of hexes up to: ") if cumulative else ""
    titles = [prefix + name for name in names]
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
