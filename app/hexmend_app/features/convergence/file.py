"""The convergence charts as a file: a figure, or the figures of all runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.suffixes import suffix_for
from hexmend.report.convergence import DrawnChart, DrawnCurve, write_convergence_figure
from hexmend.report.documents import write_csv
from hexmend.report.plots import FIGURE_SUFFIXES
from hexmend_app.features.convergence.curves import Curve
from hexmend_app.features.convergence.line import colour_of
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.features.convergence.plot import ConvergencePlot


def write_convergence(path: Path, panel: ConvergencePanel, title: str) -> None:
    """Write the charts as they are drawn, as SVG, PDF or PNG, or all figures of all runs as CSV, by the path's suffix.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    if suffix_for(path, "a chart", (*FIGURE_SUFFIXES, ".csv")) == ".csv":
        write_csv(path, [row for curve in panel.curves for row in rows(curve)])
        return
    label = "seconds in the method" if panel.by_time else "iteration"
    write_convergence_figure(path, [_drawn(plot, panel) for plot in panel.drawn], title=title, xlabel=label)


def rows(curve: Curve) -> list[dict]:
    """A row an iteration: the run, what it branched from, and every figure that there is."""
    record = curve.record
    parent = record.parent.name if record.parent is not None else ""
    each = curve.columns.of("step_seconds")
    return [
        {"run": record.name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(record.rows, each.tolist(), strict=False))
    ]


def _drawn(plot: ConvergencePlot, panel: ConvergencePanel) -> DrawnChart:
    curves = []
    for curve in panel.curves:
        for at, quantity in enumerate(plot.chart.quantities if curve.shown else ()):
            several = f" {quantity.title}" if len(plot.chart.quantities) > 1 else ""
            x, y = curve.x(panel.by_time), curve.columns.of(quantity.key)
            if np.isfinite(y).any():
                name, colour = curve.record.name + several, colour_of(curve).of(dark=False)
                curves.append(DrawnCurve(name, colour, x.tolist(), y.tolist(), bool(at), curve.current))
    return DrawnChart(plot.chart.title, curves, plot.is_log, plot.chart.quantities[0].whole)
