"""Texts of the convergence charts: tooltips and reasons for empty charts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.features.convergence.charts import Chart
from hexmend_app.features.convergence.curves import Curve
from hexmend_app.state.mesh.history import RecordedIteration, RunRecord
from hexmend_app.state.mesh.run_record import balances
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, figure


def describe(chart: Chart, curves: Sequence[Curve], x: float, by_time: bool) -> str:
    """Return the values of all plotted runs at a position of the axis, a line each; "" if no run extends to it."""
    return "\n".join(
        _line(chart, curve, curve.nearest(x, by_time), by_time)
        for curve in curves
        if curve.shown and _extends_to(curve, x, by_time)
    )


def reason_if_blank(chart: Chart, curves: Sequence[Curve]) -> str:
    """Return the reason why a chart is empty; "" if it shows a curve, or if a run may still report a value."""
    shown = [curve for curve in curves if curve.shown]
    if not shown:
        return tr("No run selected.")
    if any(_reported(chart, curve) for curve in shown):
        return ""
    inverted = [int(curve.columns.of("inverted")[-1]) for curve in shown if _infinite(chart, curve)]
    if inverted:
        return tr("The objective is infinite: {hexes}.", hexes=counted(inverted[-1], "inverted hex"))
    return (
        tr("The method does not report its {title}.", title=tr(chart.title))
        if len(shown) == 1
        else tr("No run reports its {title}.", title=tr(chart.title))
    )


def _reported(chart: Chart, curve: Curve) -> bool:
    """Return True if a run reports a finite value, or has too few iterations to tell."""
    if _infinite(chart, curve):
        return False
    return any(curve.columns.reports(quantity.key) for quantity in chart.quantities)


def _infinite(chart: Chart, curve: Curve) -> bool:
    """Return True if a run has no objective because of inverted hexes."""
    columns = curve.columns
    if chart.key != "objective" or not len(columns) or np.isfinite(columns.of("objective")).any():
        return False
    return bool(columns.of("inverted")[-1] > 0)


def _extends_to(curve: Curve, x: float, by_time: bool) -> bool:
    positions = curve.x(by_time)
    margin = 0.5 if not by_time else 0.02 * max(positions[-1] - positions[0], 1e-9)
    return positions[0] - margin <= x <= positions[-1] + margin


def _line(chart: Chart, curve: Curve, number: int, by_time: bool) -> str:
    values = []
    for quantity in chart.quantities:
        value = curve.columns.of(quantity.key)[number]
        if np.isfinite(value):
            text = figure(int(value)) if chart.whole else _significant(float(value))
        else:
            text = tr("infinite") if quantity.key == "objective" else tr("not reported")
        row = curve.record.rows[number] if quantity.key == "objective" else {}
        formula = row.get("objective_formula")
        values.append(f"{tr(quantity.label)} {formula} {text}" if formula else f"{tr(quantity.label)} {text}")
        if balances(row):
            values.append(tr("may rise while the minima are raised"))
    seconds = tr(" at {seconds:.3g} s", seconds=curve.columns.seconds[number]) if by_time else ""
    pause = curve.record.pauses.get(number)
    paused = "\n    " + tr("paused: {reason}", reason=pause) if pause else ""
    return f"{_named(curve.record, number)}{seconds}: {', '.join(values)}{paused}"


def _named(record: RunRecord, number: int) -> str:
    return RecordedIteration(record, number).name if record.holds_times else f"{record.name} {number}"


def _significant(value: float) -> str:
    return figure(value) if value == 0 or 1e-3 <= abs(value) < 1e8 else f"{value:.3g}".replace("-", "−")
