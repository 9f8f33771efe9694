"""Several methods on the open mesh, one after another and beside the window, for one table of results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend.quality import measure
from hexmend.run import Run, StoppingCriteria
from hexmend.smoothers import Smoother
from hexmend.study import compare
from hexmend.study.table_row import Row, run_one
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.tasks.task import Task

#: Milliseconds between two looks at how far the methods are.
_PERIOD = 100


@dataclass(frozen=True, eq=False)
class MethodResult:
    """Result of one method.

    Parameters
    ----------
    row : Row
        Of the core's table: figures, time, outcome.
    state : State or None
        The mesh as the method left it; None where it failed.
    """

    row: Row
    state: State | None


@dataclass(frozen=True, eq=False)
class ComparisonData:
    """Data of a comparison in a session file: initial state, limits, number of methods requested, results."""

    initial: State | None
    stop: StoppingCriteria
    asked: int
    results: tuple[MethodResult, ...]

    def __post_init__(self) -> None:
        if self.results and self.initial is None:
            raise ValueError("there are results of a comparison that began with nothing")

    @property
    def rows(self) -> tuple[Row, ...]:
        """Of the core's table."""
        return tuple(one.row for one in self.results)

    @property
    def interrupted(self) -> bool:
        """True if the user ended the comparison before the last method had finished."""
        return len(self.results) < self.asked or any(row.outcome == "stopped" for row in self.rows)

    def record(self) -> dict[str, Any]:
        """The table of what is done, for `hexmend.report`, as `hexmend compare` writes it."""
        initial = self.initial
        return compare.Comparison(initial.mesh, initial.summary, self.stop, self.rows, self.interrupted).record()


@dataclass(frozen=True)
class ComparisonProgress:
    """Progress of a comparison: active method, its place among all, iterations done and seconds they took."""

    method: str
    at: int
    of: int
    iteration: int = 0
    seconds: float = 0.0


class _Work:
    """Methods one after another on one mesh; what is done is in `done`, in their order."""

    def __init__(self, state: State, smoothers: Sequence[Smoother], stop: StoppingCriteria):
        self.task = Task("smoother comparison", self._run, yields=True)
        self.done: list[MethodResult] = []
        self.progress = ComparisonProgress(smoothers[0].name, 0, len(smoothers))
        self._order = (state, smoothers, stop)

    def _run(self, task: Task) -> None:
        """Run the methods, in the thread; a method that fails has a row, and the others continue."""
        state, smoothers, stop = self._order
        for at, smoother in enumerate(smoothers):
            if task.cancelled.is_set():
                break
            self.progress = ComparisonProgress(smoother.name, at, len(smoothers))
            row, _ = run_one(state.mesh, smoother, stop, self._watch)
            self.done.append(_compared(row))

    def _watch(self, run: Run) -> bool:
        was, last = self.progress, run.last
        self.progress = ComparisonProgress(was.method, was.at, was.of, last.number, last.seconds)
        return not self.task.cancelled.is_set()


def _compared(row: Row) -> MethodResult:
    if row.mesh is None:
        return MethodResult(row, None)
    return MethodResult(row, State(row.mesh, measure(row.mesh.points, row.mesh.hexes), row.after))


class Comparison(QObject):
    """Runs methods on the mesh as it is, which itself stays as it is.

    Signals
    -------
    changed
        There are other results, or the work has begun or ended.
    progressed
        The method at work is further.
    """

    changed = Signal()
    progressed = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._work: _Work | None = None
        self._stop = StoppingCriteria()
        self._asked = 0
        self.initial: State | None = None
        self.results: tuple[MethodResult, ...] = ()
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD)
        self._timer.timeout.connect(self._look)
        document.mesh_replaced.connect(self._empty)

    @property
    def busy(self) -> bool:
        """True while methods run."""
        return self._work is not None

    @property
    def progress(self) -> ComparisonProgress | None:
        """Progress of the work; None if none is active."""
        return self._work and self._work.progress

    @property
    def stop(self) -> StoppingCriteria:
        """The limits of the work that was begun last."""
        return self._stop

    @property
    def ending(self) -> bool:
        """True if the work ends after the current iteration."""
        return self._work is not None and self._work.task.cancelled.is_set()

    @property
    def interrupted(self) -> bool:
        """True if the user ended the comparison before the last method had finished."""
        return not self.busy and self.to_data().interrupted

    def start(self, smoothers: Sequence[Smoother], stop: StoppingCriteria) -> None:
        """Run these on the document's mesh as it is now, one after another; what was compared before is forgotten."""
        if self.busy or not self._document.is_open or not smoothers:
            return
        self.initial, self.results = self._document.now, ()
        self._stop, self._asked = stop, len(smoothers)
        self._work = _Work(self.initial, tuple(smoothers), stop)
        self._work.task.start()
        self._timer.start()
        self.changed.emit()

    def cancel(self) -> None:
        """End the work after the iteration at hand; what the method reached is its result, and the others have none."""
        if self._work is not None:
            self._work.task.cancel()
            self.progressed.emit()

    def of(self, method: str) -> MethodResult | None:
        """The result of a method; None where there is none yet."""
        return next((one for one in self.results if one.row.method == method), None)

    def to_data(self) -> ComparisonData:
        """Return the data of the finished methods for a session file."""
        return ComparisonData(self.initial, self._stop, self._asked, self.results)

    def restore(self, data: ComparisonData) -> None:
        """Take what a session has kept for what was compared last."""
        self.close()
        self.initial, self._stop, self._asked, self.results = data.initial, data.stop, data.asked, data.results
        self.changed.emit()

    def close(self) -> None:
        """Ask the work to end after the iteration at hand; nothing is emitted any more."""
        self._timer.stop()
        if self._work is not None:
            self._work.task.drop()
            self._work = None

    def _empty(self) -> None:
        self.close()
        self.initial, self.results, self._asked, self._stop = None, (), 0, StoppingCriteria()
        self.changed.emit()

    def _look(self) -> None:
        work = self._work
        over = work.task.over
        done = tuple(work.done)
        if over:
            self._timer.stop()
            work.task.wait()
            self._work = None
            if work.task.error is not None:
                raise work.task.error
        if over or len(done) != len(self.results):
            self.results = done
            self.changed.emit()
        else:
            self.progressed.emit()
