"""Charts of the quantities of a run, and values of runs as curves in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.iteration.figures import DIAGNOSTICS, HISTORY, objective_changes
from hexmend.quantity import Quantity, format_significant
from hexmend_app.report.convergence import DASHES, Line, LineChart
from hexmend_app.state.mesh.run_record import RunRecord, balances
from hexmend_app.theme.palette import RUN_COLOURS, Role
from hexmend_app.translation import tr

#: Seconds per iteration: the plot computes them from the recorded times.
STEP_SECONDS = Quantity(
    "step_seconds", "seconds per iteration", "Time that the method took for each iteration.", format_significant, -1
)
_QUANTITIES = HISTORY | DIAGNOSTICS | {STEP_SECONDS.key: STEP_SECONDS}


@dataclass(frozen=True)
class Chart:
    """Chart of one or more quantities with a common axis.

    Parameters
    ----------
    key, title : str
    quantities : tuple of Quantity
        Of `HISTORY` or `DIAGNOSTICS`, or `STEP_SECONDS`.
    log : bool
        A logarithmic axis suits them.
    whole : bool
        Their values are integers.
    """

    key: str
    title: str
    quantities: tuple[Quantity, ...]
    log: bool = False
    whole: bool = False

    @property
    def help(self) -> str:
        """Help texts of the quantities."""
        return " ".join(one.help for one in self.quantities)


def _chart(key: str, *quantities: str, title: str = "", log: bool = False, whole: bool = False) -> Chart:
    """Return a chart of some quantities; by default of the one whose key it has."""
    shown = tuple(_QUANTITIES[one] for one in quantities or (key,))
    return Chart(key, title or shown[0].label, shown, log, whole)


#: Charts by key, in menu order.
CHARTS: dict[str, Chart] = {
    chart.key: chart
    for chart in (
        _chart("objective", log=True),
        _chart("quality", "q_min", "q_mean", "scaled_jacobian_min", title="quality"),
        _chart("inverted", "inverted", "invalid", title="invalid hexes", log=True, whole=True),
        _chart("largest_move", log=True),
        _chart("gradient_norm", log=True),
        _chart("step_length", log=True),
        _chart("solver_iterations", whole=True),
        _chart("backtracks", whole=True),
        _chart("step_seconds", log=True),
        _chart("delta", log=True),
    )
}

#: Charts shown by default.
DEFAULT_CHARTS = ("objective", "quality", "inverted")


@dataclass
class Curve:
    """Curve of a run in the charts, with the iterations that it has so far.

    Parameters
    ----------
    record : RunRecord
    slot : int
        Index of its colour.
    start : (iteration, seconds)
        Position of the first iteration on the axis.
    shown, current : bool
        The run is plotted; the run is selected in the timeline.
    running : bool
        The run has not ended.
    """

    record: RunRecord
    slot: int
    start: tuple[float, float] = (0.0, 0.0)
    shown: bool = True
    current: bool = True
    running: bool = False

    def __post_init__(self) -> None:
        self.rows = list(self.record.rows)  # the run's thread may append more meanwhile

    def of(self, key: str) -> np.ndarray:
        """Return the values of a quantity, (k,) float64; nan if there is no value."""
        if key == STEP_SECONDS.key:
            seconds = np.full(len(self.rows), np.nan) if self.record.holds_times else self.of("seconds")
            return np.diff(seconds, prepend=np.nan)
        values = np.array([row.get(key) for row in self.rows], dtype=float)
        if key == "largest_move":
            values[:1] = np.nan  # nothing has moved at the start
        return values

    def x(self, by_time: bool) -> np.ndarray:
        """Return the axis positions of the iterations, (k,) float64."""
        return self.start[1] + self.of("seconds") if by_time else self.start[0] + np.arange(len(self.rows))

    def drawn(self, key: str, by_time: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of a quantity, (k,) float64; nan is a gap where the objective changes or may rise."""
        breaks = sorted({*objective_changes(self.rows), *_balance_starts(self.rows)}) if key == "objective" else []
        return np.insert(self.x(by_time), breaks, np.nan), np.insert(self.of(key), breaks, np.nan)

    def nearest(self, x: float, by_time: bool) -> int:
        """Return the iteration nearest to a position on the axis."""
        return int(np.abs(self.x(by_time) - x).argmin())


def described(chart: Chart, curves: Sequence[Curve], by_time: bool, log: bool, for_print: bool = False) -> LineChart:
    """Describe a chart of the runs that are shown, to be drawn.

    Parameters
    ----------
    chart : Chart
    curves : sequence of Curve
    by_time : bool
        Plot against seconds instead of iterations.
    log : bool
        Use a logarithmic axis if it suits the chart.
    for_print : bool
        Use the colours of the light theme instead of those of the current one.
    """
    lines = []
    for curve in (curve for curve in curves if curve.shown):
        role = colour_of(curve)
        for dash, quantity in zip(DASHES, chart.quantities, strict=False):
            x, y = curve.drawn(quantity.key, by_time)
            if np.isfinite(y).any():
                colour = role.light if for_print else str(role)
                part = quantity.label if len(chart.quantities) > 1 else ""
                lines.append(Line(curve.record.name, colour, x, y, dash, curve.current, part))
    return LineChart(chart.title, lines, log and chart.log, chart.whole)


def colour_of(curve: Curve) -> Role:
    """Return the colour of a run."""
    return RUN_COLOURS[curve.slot % len(RUN_COLOURS)]


def axis_title(curves: Sequence[Curve], by_time: bool) -> str:
    """Return the title of the axis: time of a simulated case, seconds in the method, or iterations."""
    times = [curve.record.holds_times for curve in curves if curve.shown]
    if times and all(times):
        return tr("time of the case, s") if by_time else tr("time step number")
    return tr("seconds in the method") if by_time else "iteration"


def run_start(record: RunRecord) -> tuple[float, float]:
    """Return the start of a run in iterations and seconds; a branch starts where it left its parent."""
    iteration, seconds = 0.0, 0.0
    while record.parent is not None:
        number, record = record.parent.number, record.parent.record
        iteration += number
        seconds += record.rows[number]["seconds"]
    return iteration, seconds


def table_rows(curve: Curve, names: Mapping[str, str]) -> list[dict[str, Any]]:
    """Return a row for each iteration of a run: the run, its parent, and all values; `names` maps to printed names."""
    record, step_seconds = curve.record, curve.of("step_seconds")
    name = names.get(record.name) or record.name
    parent = "" if record.parent is None else names.get(record.parent.name) or record.parent.name
    return [
        {"run": name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(curve.rows, step_seconds.tolist(), strict=True))
    ]


def _balance_starts(rows: Sequence[Mapping[str, Any]]) -> list[int]:
    """Return the iterations at which a stage begins that raises the minimum scaled Jacobian and q(H)."""
    in_balance = [balances(row) for row in rows]
    return [at for at in range(1, len(in_balance)) if in_balance[at] and not in_balance[at - 1]]
