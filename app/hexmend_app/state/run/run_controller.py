"""Controller of runs: start, pause, step, stop, and the newest iteration thirty times a second."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from enum import Enum
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend.advice import Advice
from hexmend.iteration import Outcome
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import Command, Document, MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.run.breakpoints import NONE, Breakpoints
from hexmend_app.state.run.run_setup import rules_text, settings_text
from hexmend_app.state.run.worker import IterationFrame, Worker

#: Milliseconds between two checks of the mailbox.
_PERIOD = 33


class Phase(Enum):
    """Phase of a run."""

    IDLE = "idle"
    PREPARING = "preparing"
    STOPPING = "stopping"
    RUNNING = "running"
    PAUSED = "paused"
    FINISHED = "finished"


class RunController(QObject):
    """Runs smoothers on the document's mesh in a worker thread.

    Attributes
    ----------
    phase : Phase
    work : Smoother, Recipe or None
        Method or recipe of the active or last run.
    record : RunRecord or None
        Record of the active or last run.
    advice : Advice or None
        Why the last run ended, and what to do.
    outcome : Outcome or None
        Why the last run ended; None if it failed.
    history : History
        Records of all runs.
    breakpoints : Breakpoints
        Events at which runs pause, set by `set_breakpoints`.
    shows_every : bool
        Runs wait until each iteration is shown; otherwise the newest is shown thirty times a second.
    following : bool
        True if iterations are shown as they come; False while the user looks at earlier ones.
    iterating : bool
        True while another iteration is shown and nothing else has changed.

    Signals
    -------
    phase_changed
    iterated(IterationFrame)
        The newest iteration. Iterations between two checks of the mailbox are not emitted, but recorded, unless every
        one is shown.
    hit(IterationFrame)
        The run has reached a breakpoint and pauses.
    ended(Result)
        The run has ended, and the document has its result as one change.
    failed(Exception)
        The method raised an exception; the document has the last iteration before it, if there is one.
    """

    phase_changed = Signal()
    iterated = Signal(object)
    hit = Signal(object)
    ended = Signal(object)
    failed = Signal(object)

    def __init__(self, document: Document, history: History, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.history = history
        self._worker: Worker | None = None
        self._title = ""
        self._after_end: list[Callable[[], object]] = []
        self._metrics: frozenset[str] = frozenset()
        self.breakpoints = Breakpoints()
        self.work: Smoother | Recipe | None = None
        self.record: RunRecord | None = None
        self.advice: Advice | None = None
        self.outcome: Outcome | None = None
        self._result: MeasuredMesh | None = None  # recorded at the end of the last run
        self.following = True
        self.iterating = False
        self.phase = Phase.IDLE
        self.shows_every = False
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD)
        self._timer.timeout.connect(self._update)
        document.mesh_replaced.connect(self._on_mesh_replaced)

    @property
    def busy(self) -> bool:
        """True while a run is active, paused or not."""
        return self._worker is not None

    @property
    def newest(self) -> IterationFrame | None:
        """Newest iteration of the active run; None without one."""
        return None if self._worker is None else self._worker.last

    @property
    def undone(self) -> bool:
        """True if the last run has ended, and its result was undone or reset."""
        ended = self.phase is Phase.FINISHED and self._result is not None
        return ended and not self._document.in_effect(self._result)

    def start(
        self,
        smoother: Smoother | Recipe,
        stop: StoppingCriteria | None,
        iterations: float = math.inf,
        rules: MotionRules | None = None,
    ) -> None:
        """Start a run on the current mesh, and pause it after some iterations.

        Parameters
        ----------
        smoother : Smoother or Recipe
        stop : StoppingCriteria or None
            None for a recipe, whose stages have their own.
        iterations : float
            Iterations after which the run pauses; by default it does not.
        rules : MotionRules, optional
            Rules of motion of this run; a recipe has its own.
        """
        if self.busy or not self._document.is_open:
            return
        before = self._document.now
        self.work, self._title = smoother, smoother.title
        self.record = self.history.begin(smoother.title, before)
        rules = smoother.rules if isinstance(smoother, Recipe) else rules or MotionRules()
        record = partial(self.history.add, self.record)
        self._worker = Worker(before.mesh, smoother, stop, record, rules)
        if isinstance(smoother, Recipe):
            self.record.recipe = smoother
        else:
            self.record.recipe = Recipe.of(Stage(smoother, stop or StoppingCriteria()), rules=rules)
        self.record.settings = "; ".join(filter(None, (settings_text(smoother, stop), rules_text(rules))))
        self._worker.metrics, self._worker.breakpoints = self._metrics, self.breakpoints
        self._worker.shows_every = self.shows_every
        self._worker.set_remaining(iterations)
        self.following = True
        self._set_phase(Phase.PREPARING)
        self._worker.task.start()
        self._timer.start()

    def request_metrics(self, metrics: Iterable[str]) -> None:
        """Let the worker compute these metrics for every iteration, to relieve the window."""
        self._metrics = frozenset(metrics)
        if self._worker is not None:
            self._worker.metrics = self._metrics

    def show_every(self, on: bool) -> None:
        """Let runs wait until each iteration is shown, or not."""
        self.shows_every = on
        if self._worker is not None:
            self._worker.shows_every = on

    def follow(self, on: bool) -> None:
        """Show iterations as they come, starting with the newest, or stop doing so."""
        self.following = on
        if on and self.newest is not None:
            self._preview(self.newest)

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Set the breakpoints at which runs pause."""
        self.breakpoints = breakpoints
        if self._worker is not None:
            self._worker.breakpoints = breakpoints

    def to_data(self) -> Breakpoints:
        """Return the breakpoints for a session file."""
        return self.breakpoints

    def restore(self, data: Breakpoints) -> None:
        """Restore the breakpoints of a session file."""
        self.set_breakpoints(data)

    def pause(self) -> None:
        """Pause after the current iteration."""
        if self._worker is not None:
            self._worker.set_remaining(0)

    def resume(self) -> None:
        """Resume the run, and show its iterations."""
        if self._worker is not None:
            self.following = True
            self._worker.set_remaining(math.inf)
            self._update()

    def step(self, iterations: int = 1) -> None:
        """Run some more iterations, show them, and pause."""
        if self._worker is not None:
            self.following = True
            self._worker.add_remaining(iterations)
            self._update()

    def change(self, stage: Stage) -> None:
        """Continue the current stage with another method, other values or other limits."""
        if self._worker is not None:
            self._worker.change(stage)
            self.record.recipe = None
            change = f"{stage.smoother.name} {settings_text(stage.smoother, stage.stop)}".strip()
            self.record.settings = "; ".join(filter(None, (self.record.settings, change)))
            if isinstance(self.work, Recipe):
                at = self.record.rows[-1]["stage"] - 1
                stages = (*self.work.stages[:at], stage, *self.work.stages[at + 1 :])
                self.work = replace(self.work, stages=stages)

    def stop(self) -> None:
        """End the run after the current iteration, or when it is prepared, and keep its result."""
        if self._worker is not None:
            self._worker.end()
            self._set_phase(Phase.STOPPING)

    def finish_then(self, then: Callable[[], object]) -> None:
        """End the run after the current iteration, record its result, then call a function.

        The function is called at once if no run is active; several functions are called in the order of the calls.
        """
        if self._worker is None:
            then()
            return
        self._after_end.append(then)
        self.stop()

    def _on_mesh_replaced(self) -> None:
        """Discard the run on the previous mesh, and breakpoints at its hexes and nodes."""
        self.close()
        self.work = self.record = self.advice = self.outcome = self._result = None
        of_mesh: dict[str, Any] = {"hex": NONE, "node": NONE}
        self.breakpoints = replace(self.breakpoints, **of_mesh)
        self._set_phase(Phase.IDLE)

    def close(self) -> None:
        """Cancel the run; nothing more of it is shown or recorded."""
        self._timer.stop()
        self._after_end.clear()
        if self._worker is not None:
            self._worker.end()
            self._worker.task.drop()
            self._worker = None
            self.history.finish(self.record, None, None, "")
            self._set_phase(Phase.IDLE)

    def _update(self) -> None:
        worker = self._worker
        if worker is None:
            return
        over, waits = worker.task.over, worker.waiting  # before the mailbox is emptied
        frame = worker.mailbox.take()
        if frame is not None and not over:
            self._show(frame)
        if over:
            self._finish(worker)
        elif worker.prepared.is_set() and self.phase is not Phase.STOPPING:
            self._set_phase(Phase.PAUSED if waits else Phase.RUNNING)

    def _show(self, frame: IterationFrame) -> None:
        if frame.hit is not None:
            self.record.pauses[frame.iteration.number] = frame.hit.sentence
        self.iterating = self.phase is Phase.RUNNING and frame.hit is None
        self.following = self.following or frame.hit is not None
        if self.following:
            self._preview(frame)
        self.iterated.emit(frame)
        self.iterating = False
        if frame.hit is not None:
            self.hit.emit(frame)

    def _preview(self, frame: IterationFrame) -> None:
        self.history.register_state(frame.state, RecordedIteration(self.record, frame.iteration.number))
        self._document.preview(frame.state)

    def _finish(self, worker: Worker) -> None:
        self._timer.stop()
        worker.task.wait()
        self._worker = None
        error, last, record = worker.task.error, worker.last, self.record
        record.recipe, record.better = worker.recipe, worker.better
        self.outcome = record.outcome = worker.task.result.outcome if error is None else None
        message = worker.task.result.message if error is None else f"Failed: {error}."
        reached, end = self._kept(last)
        self.history.finish(record, reached, end, message)
        if end is not None:
            self._document.commit(self._title, end, show=self.following, command=self._command_of(end))
        if error is not None:
            self._set_phase(Phase.IDLE)
            self.failed.emit(error)
        else:
            self._result = self._document.recorded
            if last is not None:
                self.iterated.emit(last)
            self.advice = record.advice = worker.advice
            self._set_phase(Phase.FINISHED)
            self.ended.emit(worker.task.result)
        callbacks, self._after_end = self._after_end, []
        for callback in callbacks:
            callback()

    def _kept(self, last: IterationFrame | None) -> tuple[RecordedIteration | None, MeasuredMesh | None]:
        """Return the iteration that a run keeps, with its state: the one that is shown if the user has stopped it."""
        shown = self.history.iteration_of(self._document.now)
        if self.outcome is Outcome.STOPPED and not self.following and shown is not None and shown.record is self.record:
            return shown, self._document.now
        if last is None:
            return None, None
        number = last.iteration.number
        return RecordedIteration(self.record, number), last.state if number else self.record.start

    def _command_of(self, end: MeasuredMesh) -> Command | None:
        """Return the call that makes the result of the run."""
        if end is self.record.start:
            return None
        return self.history.command_of(end, self._document.recorded)

    def _set_phase(self, phase: Phase) -> None:
        if phase is not self.phase:
            self.phase = phase
            self.phase_changed.emit()
