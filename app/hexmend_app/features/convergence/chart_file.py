"""The convergence charts as a file: a figure, or the figures of all runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from hexmend.io.storage.suffixes import suffix_for
from hexmend.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend.report.convergence import Convergence, DrawnChart, DrawnCurve
from hexmend.report.documents import write_csv
from hexmend_app.features.convergence.charts import CHARTS, FIRST, Chart
from hexmend_app.features.convergence.curves import Columns, Curve, beginning, colour_of
from hexmend_app.state.mesh.run_record import RunRecord

#: Kinds of file.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


def write_convergence(
    path: str | Path,
    title: str,
    runs: Sequence[RunRecord],
    charts: Sequence[str] = FIRST,
    *,
    by_time: bool = False,
    log: bool = True,
    from_zero: bool = False,
    current: RunRecord | None = None,
    style: ChartStyle | None = None,
) -> None:
    """Write how runs went: charts as SVG, PDF or PNG, or all figures of all runs as CSV, by the path's suffix.

    Parameters
    ----------
    path : path-like
    title : str
        Above the figure.
    runs : sequence of Record
        The oldest first.
    charts : sequence of str
        Names of `hexmend_app.features.convergence.charts.CHARTS`.
    by_time : bool
        Against seconds, not iterations.
    log : bool
        Axes of what says more so go by powers of ten.
    from_zero : bool
        Branches begin at 0, not where they left their run.
    current : Record, optional
        The run that is drawn strongly.
    style : ChartStyle, optional
        Sizes and names.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    style = ChartStyle() if style is None else style
    if suffix_for(Path(path), "a chart", SUFFIXES) == ".csv":
        write_csv(Path(path), [row for run in runs for row in _rows(run, style.names)])
    else:
        drawn = figure(title, runs, charts, by_time=by_time, log=log, from_zero=from_zero, current=current)
        write_chart(Path(path), drawn.draw, style)


def figure(
    title: str,
    runs: Sequence[RunRecord],
    charts: Sequence[str] = FIRST,
    *,
    by_time: bool = False,
    log: bool = True,
    from_zero: bool = False,
    current: RunRecord | None = None,
) -> Convergence:
    """The charts, on white paper; see `write_convergence`."""
    curves = [_curve(run, from_zero, run is current) for run in runs if run.plotted and run.rows]
    drawn = [_drawn(CHARTS[key], curves, by_time, log) for key in charts]
    return Convergence(drawn, title, "seconds in the method" if by_time else "iteration", not by_time)


def _curve(run: RunRecord, from_zero: bool, current: bool) -> Curve:
    columns = Columns(run)
    columns.grow()
    return Curve(
        columns,
        run.slot,
        (0.0, 0.0) if from_zero else beginning(run),
        shown=True,
        current=current,
        going=False,
        kept=run.numbers,
    )


def _rows(run: RunRecord, names: Mapping[str, str]) -> list[dict]:
    """A row an iteration: the run, what it branched from, and every figure that there is; `names` are others' names."""
    columns = Columns(run)
    columns.grow()
    name = names.get(run.name) or run.name
    parent = "" if run.parent is None else names.get(run.parent.name) or run.parent.name
    each = columns.of("step_seconds")
    return [
        {"run": name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(run.rows, each.tolist(), strict=False))
    ]


def _drawn(chart: Chart, curves: Sequence[Curve], by_time: bool, log: bool) -> DrawnChart:
    drawn = []
    for curve in curves:
        for at, quantity in enumerate(chart.quantities):
            part = quantity.title if len(chart.quantities) > 1 else ""
            x, y = curve.drawn(quantity.key, by_time)
            if np.isfinite(y).any():
                name, colour = curve.record.name, colour_of(curve).light
                drawn.append(DrawnCurve(name, colour, x.tolist(), y.tolist(), bool(at), curve.current, part))
    return DrawnChart(chart.title, drawn, log and chart.quantities[0].log, chart.quantities[0].whole)
