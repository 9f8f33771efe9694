"""Smoothing as the window sees it: run, pause, step, stop, and the newest iteration thirty times a second."""

from __future__ import annotations

import math
from collections.abc import Iterable
from enum import Enum

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend import compiling
from hexmend.optimise import Result
from hexmend.run import Stop
from hexmend.smoothers import Smoother
from hexmend_app.state.document import Document, State
from hexmend_app.state.worker import Frame, Worker

#: Milliseconds between two looks into the mailbox.
_PERIOD = 33


class Phase(Enum):
    """Where a run is."""

    IDLE = "idle"
    PREPARING = "preparing"
    STOPPING = "stopping"
    RUNNING = "running"
    PAUSED = "paused"
    FINISHED = "finished"


class Smoothing(QObject):
    """Runs smoothers on the document's mesh in a worker thread.

    Signals
    -------
    phase_changed
    iterated(Frame)
        The newest iteration; those between two looks are not shown, their figures are in the result's history.
    ended(Result)
        The run is over, and the document holds its last iteration as one change.
    failed(Exception)
        The method raised; the document is as it was before the run.
    """

    phase_changed = Signal()
    iterated = Signal(object)
    ended = Signal(object)
    failed = Signal(object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._before: State | None = None
        self._worker: Worker | None = None
        self._title = ""
        self.method = ""  # name of the method that ran last
        self._metrics: frozenset[str] = frozenset()
        self.phase = Phase.IDLE
        self._compiled, self._said = 0, False
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD)
        self._timer.timeout.connect(self._look)
        document.mesh_replaced.connect(self.shut_down)  # what was begun while the other mesh was read

    @property
    def busy(self) -> bool:
        """Whether a run is under way, paused or not."""
        return self._worker is not None

    @property
    def compiling(self) -> bool:
        """Whether kernels had to be compiled since the run was asked for."""
        return compiling.begun > self._compiled

    def start(self, smoother: Smoother, stop: Stop, iterations: float = math.inf) -> None:
        """Begin a run on the document's mesh and make that many iterations of it."""
        if self.busy or not self._document.is_open:
            return
        self._before = self._document.now
        self._title, self.method = smoother.title, smoother.name
        self._worker = Worker(self._before.mesh, smoother, stop)
        self._worker.metrics = self._metrics
        self._worker.grant(iterations)
        self._compiled, self._said = compiling.begun, False
        self._set_phase(Phase.PREPARING)
        self._worker.start()
        self._timer.start()

    def want(self, metrics: Iterable[str]) -> None:
        """Have the worker measure these metrics of every iteration, so that the window need not."""
        self._metrics = frozenset(metrics)
        if self._worker is not None:
            self._worker.metrics = self._metrics

    def pause(self) -> None:
        """Pause after the iteration at hand."""
        if self._worker is not None:
            self._worker.grant(0)

    def resume(self) -> None:
        """Go on."""
        if self._worker is not None:
            self._worker.grant(math.inf)
            self._look()

    def step(self) -> None:
        """Make one more iteration and pause."""
        if self._worker is not None:
            self._worker.grant_one_more()
            self._look()

    def stop(self) -> None:
        """End the run after the iteration at hand, or once it is prepared; what was reached stays."""
        if self._worker is not None:
            self._worker.end()
            if self.phase is Phase.PREPARING:
                self._set_phase(Phase.STOPPING)

    def end_now(self) -> None:
        """End the run and wait for the iteration at hand; what was reached is recorded as usual."""
        if self._worker is not None:
            self._worker.end()
            self._worker.wait()
            self._finish(self._worker)

    def shut_down(self) -> None:
        """End the run and wait until its thread is gone; nothing is emitted any more."""
        self._timer.stop()
        if self._worker is not None:
            self._worker.end()
            self._worker.wait()
            self._worker = None
            self._set_phase(Phase.IDLE)

    def _look(self) -> None:
        worker = self._worker
        if worker is None:
            return
        over = worker.isFinished()
        frame = worker.mailbox.take()
        if frame is not None and not over:
            self._show(frame)
        if over:
            self._finish(worker)
        elif self.phase is Phase.PREPARING and self.compiling and not self._said:
            self._said = True
            self.phase_changed.emit()
        elif worker.prepared.is_set() and self.phase is not Phase.STOPPING:
            self._set_phase(Phase.PAUSED if worker.waiting else Phase.RUNNING)

    def _show(self, frame: Frame) -> None:
        self._document.preview(frame.state)
        self.iterated.emit(frame)

    def _finish(self, worker: Worker) -> None:
        self._timer.stop()
        worker.wait()
        self._worker = None
        if worker.error is not None:
            self._document.preview(self._before)
            self._set_phase(Phase.IDLE)
            self.failed.emit(worker.error)
            return
        if worker.last is not None:
            self._document.commit(self._title, worker.last.state)
            self.iterated.emit(worker.last)
        self._set_phase(Phase.FINISHED)
        self.ended.emit(worker.result)

    def _set_phase(self, phase: Phase) -> None:
        if phase is not self.phase:
            self.phase = phase
            self.phase_changed.emit()


__all__ = ["Frame", "Phase", "Result", "Smoothing"]
