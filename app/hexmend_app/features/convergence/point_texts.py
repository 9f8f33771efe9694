"""Texts of the convergence charts for the iteration under the mouse."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.features.convergence.charts import Chart
from hexmend_app.features.convergence.curves import Curve
from hexmend_app.widgets.wording import counted, figure


def describe(chart: Chart, curves: Sequence[Curve], x: float, by_time: bool) -> str:
    """The figures of all runs that are plotted at a place of the axis, a line each; "" where there is none."""
    reaching = [one for one in curves if one.shown and _reaches(one, x, by_time)]
    return "\n".join(_line(chart, one, one.nearest(x, by_time), by_time) for one in reaching)


def titled(chart: Chart, curves: Sequence[Curve], dashes: Sequence[str]) -> str:
    """Return a chart's heading: dashes of its quantities if there are several, and the runs it omits."""
    quantities = chart.quantities
    several = len(quantities) > 1
    text = ", ".join(f"{one.title} {dash}" for one, dash in zip(quantities, dashes, strict=False))
    silent = [one for one in curves if one.shown and not _tells(chart, one)]
    inverted = [one.record.name for one in silent if _infinite(chart, one)]
    others = [one.record.name for one in silent if not _infinite(chart, one)]
    sentence = [text if several else chart.title]
    if inverted:
        sentence.append(
            f"{' and '.join(inverted)} {'have' if len(inverted) > 1 else 'has'} none while hexes are inverted"
        )
    if others:
        sentence.append(f"{' and '.join(others)} {'do' if len(others) > 1 else 'does'} not tell this")
    return ": ".join([sentence[0], "; ".join(sentence[1:])]) if silent else sentence[0]


def reason_if_blank(chart: Chart, curves: Sequence[Curve]) -> str:
    """Why nothing is drawn in a chart; "" where something is, or is about to be.

    A run of which there are no iterations yet tells nothing, and that is no reason.
    """
    shown = [one for one in curves if one.shown]
    if not shown:
        return "No run is ticked."
    if any(_tells(chart, one) for one in shown):
        return ""
    left = [int(one.columns.of("inverted")[-1]) for one in shown if _infinite(chart, one)]
    if left:
        some = f"{counted(left[-1], 'hex')} {'is' if left[-1] == 1 else 'are'} inverted"
        return f"{some}: the objective is infinite until none is."
    return f"The method does not tell its {chart.title}." if len(shown) == 1 else f"No run tells its {chart.title}."


def _tells(chart: Chart, curve: Curve) -> bool:
    """Return True if a run has something to draw, or may have once it has begun."""
    if _infinite(chart, curve):
        return False
    return any(curve.columns.reports(one.key) for one in chart.quantities)


def _infinite(chart: Chart, curve: Curve) -> bool:
    """Return True if a run has no objective because of inverted hexes."""
    columns = curve.columns
    if chart.key != "objective" or not len(columns) or np.isfinite(columns.of("objective")).any():
        return False
    return bool(columns.of("inverted")[-1] > 0)


def _reaches(curve: Curve, x: float, by_time: bool) -> bool:
    places = curve.x(by_time)
    spare = 0.5 if not by_time else 0.02 * max(places[-1] - places[0], 1e-9)
    return places[0] - spare <= x <= places[-1] + spare


def _line(chart: Chart, curve: Curve, number: int, by_time: bool) -> str:
    figures = []
    for quantity in chart.quantities:
        value = curve.columns.of(quantity.key)[number]
        if np.isfinite(value):
            text = figure(int(value)) if quantity.whole else _significant(float(value))
        else:
            text = "infinite" if quantity.key == "objective" else "not told"
        formula = curve.record.rows[number].get("objective_formula") if quantity.key == "objective" else None
        figures.append(f"{quantity.title} {formula} {text}" if formula else f"{quantity.title} {text}")
    kept = curve.kept()
    nearest = int(kept[np.abs(kept - number).argmin()])
    gone = "" if nearest == number else f" (nearest kept: {nearest})"
    seconds = f" at {curve.columns.seconds[number]:.3g} s" if by_time else ""
    pause = curve.record.pauses.get(number)
    paused = f"\n    paused there: {pause}" if pause else ""
    return f"{curve.record.name} {number}{seconds}: {', '.join(figures)}{gone}{paused}"


def _significant(value: float) -> str:
    return figure(value) if value == 0 or 1e-3 <= abs(value) < 1e8 else f"{value:.3g}".replace("-", "−")
