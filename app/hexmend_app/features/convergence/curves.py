"""Values of runs as curves: columns of values and positions on the axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.iteration.figures import objective_changes
from hexmend_app.features.convergence.charts import CHARTS, STEP_SECONDS, Chart
from hexmend_app.report.convergence import DASHES, Line, LineChart
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.state.mesh.run_record import balances
from hexmend_app.theme.palette import RUN_COLOURS, Role
from hexmend_app.translation import tr

_RECORDED = tuple(one.key for chart in CHARTS.values() for one in chart.quantities if one is not STEP_SECONDS)


class Columns:
    """Values of one run as arrays, (k,) float64, that grow with the run; nan if there is no value.

    Parameters
    ----------
    record : RunRecord
    """

    def __init__(self, record: RunRecord):
        self.record = record
        self._known = 0
        self._changes: list[int] = []
        self._rows = np.empty((64, len(_RECORDED) + 1))

    def grow(self) -> None:
        """Read the iterations added to the record since the last call."""
        rows = self.record.rows
        newest = len(rows)  # the run's thread may append more meanwhile
        if newest > len(self._rows):
            self._rows = np.resize(self._rows, (max(newest, 2 * len(self._rows)), len(_RECORDED) + 1))
        for at in range(self._known, newest):
            self._rows[at] = [*(_number(rows[at].get(key)) for key in _RECORDED), rows[at]["seconds"]]
        if self._known == 0 < newest:
            self._rows[0, _RECORDED.index("largest_move")] = np.nan  # nothing has moved at the start
        self._known = newest
        known = rows[:newest]
        self._changes = sorted({*objective_changes(known), *_balance_starts(known)})

    def __len__(self) -> int:
        return self._known

    @property
    def seconds(self) -> np.ndarray:
        """Seconds since the start of the run, or times of a case, (k,) float64."""
        return self._rows[: self._known, -1]

    def of(self, key: str) -> np.ndarray:
        """Return the values of a quantity, (k,) float64."""
        if key == STEP_SECONDS.key:
            if self.record.holds_times:
                return np.full(self._known, np.nan)
            return np.diff(self.seconds, prepend=np.nan)
        return self._rows[: self._known, _RECORDED.index(key)]

    def breaks(self, key: str) -> list[int]:
        """Return the iterations from which on a quantity is another one, or a stage begins that may raise it."""
        return self._changes if key == "objective" else []

    def reports(self, key: str) -> bool:
        """Return True if the method reports this quantity, or may after its first iteration."""
        return self._known < 2 or bool(np.isfinite(self.of(key)).any())


@dataclass(frozen=True, eq=False)
class Curve:
    """Curve of a run in the charts.

    Parameters
    ----------
    columns : Columns
    slot : int
        Index of its colour.
    start : (iteration, seconds)
        Position of the first iteration on the axis.
    shown, current : bool
        The run is plotted; the run is selected in the timeline.
    running : bool
        The run has not ended.
    """

    columns: Columns
    slot: int
    start: tuple[float, float]
    shown: bool
    current: bool
    running: bool

    @property
    def record(self) -> RunRecord:
        """Record of the run."""
        return self.columns.record

    def x(self, by_time: bool) -> np.ndarray:
        """Return the axis positions of the iterations, (k,) float64."""
        if by_time:
            return self.start[1] + self.columns.seconds
        return self.start[0] + np.arange(len(self.columns))

    def drawn(self, key: str, by_time: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of a quantity, (k,) float64; nan is a gap, for example where the objective changes."""
        breaks = self.columns.breaks(key)
        return np.insert(self.x(by_time), breaks, np.nan), np.insert(self.columns.of(key), breaks, np.nan)

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


def table_rows(columns: Columns, names: Mapping[str, str]) -> list[dict[str, Any]]:
    """Return a row for each iteration of a run: the run, its parent, and all values; `names` maps to printed names."""
    record, step_seconds = columns.record, columns.of("step_seconds")
    name = names.get(record.name) or record.name
    parent = "" if record.parent is None else names.get(record.parent.name) or record.parent.name
    return [
        {"run": name, "branch_of": parent, **row, "step_seconds": seconds if at else None}
        for at, (row, seconds) in enumerate(zip(record.rows, step_seconds.tolist(), strict=False))
    ]


def _balance_starts(rows: Sequence[Mapping[str, Any]]) -> list[int]:
    """Return the iterations at which a stage begins that raises the minimum scaled Jacobian and q(H)."""
    in_balance = [balances(row) for row in rows]
    return [at for at in range(1, len(in_balance)) if in_balance[at] and not in_balance[at - 1]]


def _number(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) and np.isfinite(value) else np.nan
