"""What the convergence charts say of an iteration under the mouse."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.state.convergence import Chart, Curve
from hexmend_app.widgets.wording import figure


def describe(chart: Chart, curves: Sequence[Curve], x: float, by_time: bool) -> str:
    """The figures of all runs that are plotted at a place of the axis, a line each; "" where there is none."""
    reaching = [one for one in curves if one.shown and _reaches(one, x, by_time)]
    return "\n".join(_line(chart, one, one.nearest(x, by_time), by_time) for one in reaching)


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
        figures.append(f"{quantity.title} {text}")
    kept = curve.kept()
    nearest = int(kept[np.abs(kept - number).argmin()])
    gone = "" if nearest == number else f" (nearest kept: {nearest})"
    seconds = f" at {curve.columns.seconds[number]:.3g} s" if by_time else ""
    pause = curve.record.pauses.get(number)
    paused = f"\n    paused there: {pause}" if pause else ""
    return f"{curve.record.name} {number}{seconds}: {', '.join(figures)}{gone}{paused}"


def _significant(value: float) -> str:
    return figure(value) if value == 0 or 1e-3 <= abs(value) < 1e8 else f"{value:.3g}".replace("-", "−")
