"""Export of the convergence charts as a figure, or of the values of all runs as a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.storage.suffixes import suffix_for
from hexmend.report.records import write_csv
from hexmend_app.features.convergence.charts import CHARTS, DEFAULT_CHARTS, Chart
from hexmend_app.features.convergence.curves import Columns, Curve, axis_title, colour_of, run_start
from hexmend_app.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend_app.report.convergence import DASHES, Convergence, DrawnChart, DrawnCurve
from hexmend_app.state.mesh.run_record import RunRecord

#: Suffixes of the files that can be written.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


@dataclass(frozen=True)
class ConvergenceExport:
    """Charts of runs to be exported.

    Parameters
    ----------
    title : str
        Title of the figure.
    runs : sequence of RunRecord
        The oldest first.
    charts : sequence of str
        Keys of `hexmend_app.features.convergence.charts.CHARTS`.
    by_time : bool
        Plot against seconds instead of iterations.
    log : bool
        Use logarithmic axes for the quantities that suit them.
    from_zero : bool
        Start branches at 0 instead of where they branched off.
    current : RunRecord, optional
        Run drawn with a thick line.
    """

    title: str
    runs: Sequence[RunRecord]
    charts: Sequence[str] = DEFAULT_CHARTS
    by_time: bool = False
    log: bool = True
    from_zero: bool = False
    current: RunRecord | None = None

    def write(self, path: str | Path, style: ChartStyle | None = None) -> None:
        """Write the charts as SVG, PDF or PNG, or all values of all runs as CSV, by the suffix of the path.

        Raises
        ------
        HexmendError
            If the suffix is another one or the file cannot be written; an existing file is not changed.
        """
        style = ChartStyle() if style is None else style
        if suffix_for(Path(path), "a chart", SUFFIXES) == ".csv":
            write_csv(Path(path), [row for run in self.runs for row in _rows(run, style.names)])
        else:
            write_chart(Path(path), self.figure().draw, style)

    def figure(self) -> Convergence:
        """Return the charts as a figure for print."""
        plotted = [run for run in self.runs if run.plotted and run.rows]
        curves = [_curve(run, self.from_zero, run is self.current) for run in plotted]
        drawn = [_drawn(CHARTS[key], curves, self.by_time, self.log) for key in self.charts]
        return Convergence(drawn, self.title, axis_title(curves, self.by_time), not self.by_time)


def _curve(run: RunRecord, from_zero: bool, current: bool) -> Curve:
    columns = Columns(run)
    columns.grow()
    return Curve(
        columns,
        run.slot,
        (0.0, 0.0) if from_zero else run_start(run),
        shown=True,
        current=current,
        running=False,
        stored=run.numbers,
    )


def _rows(run: RunRecord, names: Mapping[str, str]) -> list[dict]:
    """Return a row for each iteration: the run, its parent, and all values; `names` maps runs to other names."""
    columns = Columns(run)
    columns.grow()
    name = names.get(run.name) or run.name
    parent = "" if run.parent is None else names.get(run.parent.name) or run.parent.name
    step_seconds = columns.of("step_seconds")
    return [
        {"run": name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(run.rows, step_seconds.tolist(), strict=False))
    ]


def _drawn(chart: Chart, curves: Sequence[Curve], by_time: bool, log: bool) -> DrawnChart:
    drawn = []
    for curve in curves:
        for at, quantity in enumerate(chart.quantities):
            label = quantity.title if len(chart.quantities) > 1 else ""
            x, y = curve.drawn(quantity.key, by_time)
            if np.isfinite(y).any():
                name, colour = curve.record.name, colour_of(curve).light
                drawn.append(DrawnCurve(name, colour, x.tolist(), y.tolist(), DASHES[at], curve.current, label))
    return DrawnChart(chart.title, drawn, log and chart.quantities[0].log, chart.quantities[0].whole)
