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
    if any(np.isfinite(curve.of(quantity.key)).any() for curve in shown for quantity in chart.quantities):
        return ""
    inverted = int(shown[-1].of("inverted")[-1])
    if chart.key == "objective" and inverted:
        return tr("The objective is infinite: {hexes}.", hexes=counted(inverted, "inverted hex"))
    if any(len(curve.rows) < 2 for curve in shown):
        return ""
    return tr("No run reports its {title}.", title=tr(chart.title))


def _extends_to(curve: Curve, x: float, by_time: bool) -> bool:
    positions = curve.x(by_time)
    margin = 0.5 if not by_time else 0.02 * max(positions[-1] - positions[0], 1e-9)
    return positions[0] - margin <= x <= positions[-1] + margin


def _line(chart: Chart, curve: Curve, number: int, by_time: bool) -> str:
    values = []
    for quantity in chart.quantities:
        value = curve.of(quantity.key)[number]
        if np.isfinite(value):
            text = figure(int(value)) if chart.whole else _significant(float(value))
        else:
            text = tr("infinite") if quantity.key == "objective" else tr("not reported")
        row = curve.rows[number] if quantity.key == "objective" else {}
        formula = row.get("objective_formula")
        values.append(f"{tr(quantity.label)} {formula} {text}" if formula else f"{tr(quantity.label)} {text}")
        if balances(row):
            values.append(tr("may rise while the minima are raised"))
    seconds = tr(" at {seconds:.3g} s", seconds=curve.of("seconds")[number]) if by_time else ""
    pause = curve.record.pauses.get(number)
    paused = "\n    " + tr("paused: {reason}", reason=pause) if pause else ""
    return f"{_named(curve.record, number)}{seconds}: {', '.join(values)}{paused}"


def _named(record: RunRecord, number: int) -> str:
    return RecordedIteration(record, number).name if record.holds_times else f"{record.name} {number}"


def _significant(value: float) -> str:
    return figure(value) if value == 0 or 1e-3 <= abs(value) < 1e8 else f"{value:.3g}".replace("-", "−")
