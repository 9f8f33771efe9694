"""Comparison of methods: runs several methods on the open mesh in the background, for a table of results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.errors import HexmendError
from hexmend.iteration import Outcome
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_more_rules
from hexmend.parameters import from_values
from hexmend.run import Run, StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS, Smoother
from hexmend.study import compare
from hexmend.study.compare import Row, run_one
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task

#: Seconds between two reports of the progress.
_PERIOD = 0.1


@dataclass(frozen=True, eq=False)
class MethodResult:
    """Result of one method.

    Parameters
    ----------
    row : Row
        Row of the table: quality, time, outcome.
    state : MeasuredMesh or None
        The resulting mesh; None if the method failed.
    """

    row: Row
    state: MeasuredMesh | None


@dataclass(frozen=True, eq=False)
class ComparisonData:
    """Data of a comparison in a session file: initial state, limits, number of methods requested, results, rules."""

    initial: MeasuredMesh | None = None
    stop: StoppingCriteria = field(default_factory=StoppingCriteria)
    asked: int = 0
    results: tuple[MethodResult, ...] = ()
    rules: MotionRules = field(default_factory=MotionRules)

    def __post_init__(self) -> None:
        if self.results and self.initial is None:
            raise ValueError("there are results of a comparison without an initial state")

    @property
    def rows(self) -> tuple[Row, ...]:
        """Rows of the table."""
        return tuple(result.row for result in self.results)

    @property
    def interrupted(self) -> bool:
        """True if the user ended the comparison before the last method had finished."""
        return len(self.results) < self.asked or any(row.outcome == "stopped" for row in self.rows)

    def record(self) -> dict[str, Any]:
        """Return the record of the finished methods for `hexmend.report`, as `hexmend compare` writes it."""
        initial = self.initial
        return compare.Comparison(initial.mesh, initial.summary, self.stop, self.rows, self.interrupted).record()


@dataclass(frozen=True)
class ComparisonProgress:
    """Progress of a comparison: active method, its index, number of methods, iterations done and their seconds."""

    method: str
    at: int
    of: int
    iteration: int = 0
    seconds: float = 0.0


def _run_all(
    state: MeasuredMesh, smoothers: Sequence[Smoother], stop: StoppingCriteria, rules: MotionRules, task: Task
) -> None:
    """Run methods one after another on one mesh, and report progress and results; if one fails, its row says so."""
    try:
        mesh = with_more_rules(state.mesh, rules) if rules else state.mesh
    except HexmendError as error:
        for one in smoothers:
            task.report(MethodResult(Row(one.name, one.values(), "failed", f"Failed: {error}"), None))
        return
    due = 0.0
    for at, smoother in enumerate(smoothers):
        progress = ComparisonProgress(smoother.name, at, len(smoothers))

        def watch(run: Run, progress: ComparisonProgress = progress) -> bool:
            nonlocal due
            if monotonic() > due:
                due = monotonic() + _PERIOD
                task.report(replace(progress, iteration=run.last.number, seconds=run.last.seconds))
            return not task.cancelled.is_set()

        task.report(progress)
        row, _ = run_one(mesh, smoother, stop, watch)
        task.report(_result_of(row, state.mesh))
        if task.cancelled.is_set():
            return


def _result_of(row: Row, initial: Mesh) -> MethodResult:
    """Return the result of a row; its mesh has the initial mesh's rules of motion, whatever the rules of the run."""
    if row.mesh is None:
        return MethodResult(row, None)
    mesh = initial.with_points(row.mesh.points)
    return MethodResult(replace(row, mesh=mesh), MeasuredMesh.of(mesh))


class Comparison(OneTask):
    """Runs methods on the current mesh, which is left unchanged.

    Signals
    -------
    changed
        The results have changed, or the comparison has started or ended.
    progressed
        The progress of the active method has changed.

    Attributes
    ----------
    data : ComparisonData
        The last comparison, with the results of the finished methods.
    progress : ComparisonProgress or None
        Progress of the comparison; None if none is active.
    """

    changed = Signal()
    progressed = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.progress: ComparisonProgress | None = None
        self.data = ComparisonData()
        document.mesh_replaced.connect(lambda: self.restore(ComparisonData()))

    @property
    def initial(self) -> MeasuredMesh | None:
        """State that the methods start from; None if nothing was compared."""
        return self.data.initial

    @property
    def results(self) -> tuple[MethodResult, ...]:
        """Results of the finished methods."""
        return self.data.results

    @property
    def ending(self) -> bool:
        """True if the comparison ends after the current iteration."""
        return self._task is not None and self._task.cancelled.is_set()

    @property
    def interrupted(self) -> bool:
        """True if the user ended the comparison before the last method had finished."""
        return not self.busy and self.data.interrupted

    def start(self, smoothers: Sequence[Smoother], stop: StoppingCriteria, rules: MotionRules | None = None) -> None:
        """Run methods on the current mesh, one after another; the results of the previous comparison are discarded.

        Parameters
        ----------
        smoothers : sequence of Smoother
        stop : StoppingCriteria
            Limits of each method.
        rules : MotionRules, optional
            Rules of motion of all methods, in addition to those of the mesh; the results have none.
        """
        if self.busy or not self._document.is_open or not smoothers:
            return
        self.data = ComparisonData(self._document.now, stop, len(smoothers), rules=rules or MotionRules())
        self.progress = ComparisonProgress(smoothers[0].name, 0, len(smoothers))
        work = partial(_run_all, self.initial, tuple(smoothers), stop, self.data.rules)
        self._start("comparison of methods", work, yields=True)
        self.changed.emit()

    def cancel(self) -> None:
        """End the comparison after the current iteration, which is the result of its method; the rest have none."""
        if self._task is not None:
            self._task.cancel()
            self.progressed.emit()

    def of(self, method: str) -> MethodResult | None:
        """Return the result of a method; None if there is none yet."""
        return next((result for result in self.results if result.row.method == method), None)

    def recipe_of(self, state: MeasuredMesh) -> Recipe | None:
        """Return what repeats the result that is a state; None for other states, and if the method is unknown."""
        row = next((result.row for result in self.results if result.state is state), None)
        if row is None or row.method not in METHODS:
            return None
        stop = self.data.stop
        if row.outcome in (Outcome.STOPPED.key, Outcome.MAX_SECONDS.key):
            stop = replace(stop, max_iterations=row.iterations, max_seconds=0.0)
        smoother = from_values(METHODS[row.method], row.parameters, owner=row.method)
        return Recipe.of(Stage(smoother, stop), rules=self.data.rules)

    def to_data(self) -> ComparisonData:
        """Return the data of the finished methods for a session file."""
        return self.data

    def restore(self, data: ComparisonData) -> None:
        """Restore the comparison of a session file."""
        self.close()
        self.data = data
        self.changed.emit()

    def close(self) -> None:
        """Cancel the comparison without further signals."""
        super().close()
        self.progress = None

    def _take(self, message: MethodResult | ComparisonProgress) -> None:
        if isinstance(message, MethodResult):
            self.data = replace(self.data, results=(*self.results, message))
            self.changed.emit()
        else:
            self.progress = message
            self.progressed.emit()

    def _finish(self, task: Task) -> None:
        self.progress = None
        if task.error is not None:
            raise task.error
        self.changed.emit()
