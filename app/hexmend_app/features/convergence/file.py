"""The convergence charts as a file: a figure, or the figures of all runs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hexmend.io.suffixes import suffix_for
from hexmend.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend.report.convergence import Convergence, DrawnChart, DrawnCurve
from hexmend.report.documents import write_csv
from hexmend_app.features.convergence.curves import Curve
from hexmend_app.features.convergence.line import colour_of
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.features.convergence.plot import ConvergencePlot

#: Kinds of file.
SUFFIXES = (*FIGURE_SUFFIXES, ".csv")


def write_convergence(path: Path, panel: ConvergencePanel, title: str, style: ChartStyle | None = None) -> None:
    """Write the charts as they are drawn, as SVG, PDF or PNG, or all figures of all runs as CSV, by the path's suffix.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    style = ChartStyle() if style is None else style
    if suffix_for(path, "a chart", SUFFIXES) == ".csv":
        write_csv(path, [row for curve in panel.curves for row in rows(curve, style.names)])
    else:
        write_chart(path, figure(panel, title).draw, style)


def figure(panel: ConvergencePanel, title: str) -> Convergence:
    """The charts as they are drawn, on white paper."""
    label = "seconds in the method" if panel.by_time else "iteration"
    return Convergence([_drawn(plot, panel) for plot in panel.drawn], title, label, not panel.by_time)


def rows(curve: Curve, names: Mapping[str, str] | None = None) -> list[dict]:
    """A row an iteration: the run, what it branched from, and every figure that there is.

    `names` are what runs are called, by what they call themselves.
    """
    record, names = curve.record, names or {}
    name = names.get(record.name) or record.name
    parent = "" if record.parent is None else names.get(record.parent.name) or record.parent.name
    each = curve.columns.of("step_seconds")
    return [
        {"run": name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(record.rows, each.tolist(), strict=False))
    ]


def _drawn(plot: ConvergencePlot, panel: ConvergencePanel) -> DrawnChart:
    curves = []
    for curve in panel.curves:
        for at, quantity in enumerate(plot.chart.quantities if curve.shown else ()):
            part = quantity.title if len(plot.chart.quantities) > 1 else ""
            x, y = curve.x(panel.by_time), curve.columns.of(quantity.key)
            if np.isfinite(y).any():
                name, colour = curve.record.name, colour_of(curve).of(dark=False)
                curves.append(DrawnCurve(name, colour, x.tolist(), y.tolist(), bool(at), curve.current, part))
    return DrawnChart(plot.chart.title, curves, plot.is_log, plot.chart.quantities[0].whole)
