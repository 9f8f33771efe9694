"""The figures of runs as curves: against what they are plotted, and where each run begins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hexmend.iteration.figures import objective_changes
from hexmend_app.features.convergence.charts import CHARTS, STEP_SECONDS
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.palette import BLUE, KEPT, Role

#: Colours of runs, by slot; after the last, the first again.
RUN_COLOURS = (BLUE, *KEPT)

_STORED = tuple(one.key for chart in CHARTS.values() for one in chart.quantities if one.figure is not STEP_SECONDS)


class Columns:
    """The figures of one run as arrays, (k,) float64, that grow with it; nan where there is none.

    Parameters
    ----------
    record : Record
    """

    def __init__(self, record: RunRecord):
        self.record = record
        self._known = 0
        self._changes: list[int] = []
        self._rows = np.empty((64, len(_STORED) + 1))

    def grow(self) -> None:
        """Take the iterations that there are by now."""
        rows = self.record.rows
        newest = len(rows)  # by the thread that runs, more may come meanwhile
        if newest > len(self._rows):
            self._rows = np.resize(self._rows, (max(newest, 2 * len(self._rows)), len(_STORED) + 1))
        for at in range(self._known, newest):
            self._rows[at] = [*(_number(rows[at].get(key)) for key in _STORED), rows[at]["seconds"]]
        if self._known == 0 < newest:
            self._rows[0, _STORED.index("largest_move")] = np.nan  # where it begins, nothing has moved yet
        self._known = newest
        self._changes = objective_changes(rows[:newest])

    def __len__(self) -> int:
        return self._known

    @property
    def seconds(self) -> np.ndarray:
        """Since the run began."""
        return self._rows[: self._known, -1]

    def of(self, key: str) -> np.ndarray:
        """A quantity's values."""
        if key == STEP_SECONDS.key:
            return np.diff(self.seconds, prepend=np.nan)
        return self._rows[: self._known, _STORED.index(key)]

    def breaks(self, key: str) -> list[int]:
        """Iterations from which on a quantity is another figure: the objective of another stage."""
        return self._changes if key == "objective" else []

    def reports(self, key: str) -> bool:
        """Return True if the method reports this quantity."""
        return self._known < 2 or bool(np.isfinite(self.of(key)).any())


@dataclass(frozen=True, eq=False)
class Curve:
    """A run as it is plotted.

    Parameters
    ----------
    columns : Columns
    slot : int
        What its colour goes by; it keeps it while others come and go.
    begins : (iteration, seconds)
        Where on the axis.
    shown, current : bool
        Whether it is plotted at all, and is the run that is gone through.
    going : bool
        Whether it goes on.
    kept : callable
        Numbers of the iterations whose positions are there, ascending, (k,) int.
    """

    columns: Columns
    slot: int
    begins: tuple[float, float]
    shown: bool
    current: bool
    going: bool
    kept: Callable[[], np.ndarray]

    @property
    def record(self) -> RunRecord:
        """The run."""
        return self.columns.record

    def x(self, by_time: bool) -> np.ndarray:
        """Return the axis positions of the iterations, (k,) float64."""
        if by_time:
            return self.begins[1] + self.columns.seconds
        return self.begins[0] + np.arange(len(self.columns))

    def drawn(self, key: str, by_time: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of a quantity's line, (k,) float64; nan is a gap, as where the objective changes."""
        breaks = self.columns.breaks(key)
        return np.insert(self.x(by_time), breaks, np.nan), np.insert(self.columns.of(key), breaks, np.nan)

    def nearest(self, x: float, by_time: bool) -> int:
        """Number of the iteration that is nearest to a place on the axis."""
        return int(np.abs(self.x(by_time) - x).argmin())


def colour_of(curve: Curve) -> Role:
    """The colour of a run."""
    return RUN_COLOURS[curve.slot % len(RUN_COLOURS)]


def beginning(record: RunRecord) -> tuple[float, float]:
    """Return the start of a run in iterations and seconds; a branch starts where it left its parent."""
    iteration, seconds = 0.0, 0.0
    while record.parent is not None:
        number, record = record.parent.number, record.parent.record
        iteration += number
        seconds += record.rows[number]["seconds"]
    return iteration, seconds


def thinned(x: np.ndarray, y: np.ndarray, most: int = 2000) -> tuple[np.ndarray, np.ndarray]:
    """A curve of more than `most` points by the least and the greatest value of as many pieces as make about `most`.

    Parameters
    ----------
    x, y : (k,) float64
        nan in y is a gap.
    """
    if len(x) <= most:
        return x, y
    starts = np.arange(0, len(x), -(-2 * len(x) // most))
    ends = np.stack([np.fmin.reduceat(y, starts), np.fmax.reduceat(y, starts)], axis=1)
    return np.repeat(x[starts], 2), ends.ravel()


def _number(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) and np.isfinite(value) else np.nan
