"""Navigation in the history of runs: to any iteration, step by step, or by playing."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.run.run_controller import Phase, RunController
from hexmend_app.state.settings.settings import ITERATIONS_PLAYED

#: Iterations a second at which a run is played.
SPEED = ITERATIONS_PLAYED.default


class Timeline(QObject):
    """Shows iterations of the runs on the open mesh in the document.

    Showing an iteration is no change that can be undone. A method that is run from there starts a new run: a branch.

    Attributes
    ----------
    record : RunRecord or None
        The selected run.
    shown_iteration : RecordedIteration or None
        The iteration that is shown; None if the document shows another state.
    speed : float
        Iterations per second when playing.

    Signals
    -------
    runs_changed
        A run was added or removed.
    changed
        There are more iterations, another run was selected, or playing has begun or ended.
    moved
        Another iteration is shown, or none.
    """

    runs_changed = Signal()
    changed = Signal()
    moved = Signal()

    def __init__(self, document: Document, smoothing: RunController, history: History, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._smoothing = smoothing
        self.history = history
        self.record: RunRecord | None = None
        self.speed: float = SPEED
        self._runs: list[RunRecord] = []
        self.shown_iteration: RecordedIteration | None = None
        self._target: RecordedIteration | None = None
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._go_to_target)
        self._clock = QTimer(self)
        self._clock.timeout.connect(self._play_next)
        document.mesh_replaced.connect(self._on_mesh_replaced)
        document.points_moved.connect(self._on_moved)
        smoothing.iterated.connect(lambda frame: self.changed.emit())
        smoothing.phase_changed.connect(self._on_phase)

    @property
    def live(self) -> bool:
        """True if the selected run is active and its iterations are shown as they arrive."""
        return self._smoothing.busy and self._smoothing.following

    @property
    def playing(self) -> bool:
        """True while the iterations are played."""
        return self._clock.isActive()

    def go(self, record: RunRecord, number: int) -> None:
        """Show an iteration of a run, or the nearest one whose node positions are recorded."""
        if self._smoothing.busy:
            newest = record is self._smoothing.record and number >= record.newest
            self._smoothing.follow(newest)
            if newest:
                return
        state = self.history.state(RecordedIteration(record, number), self._document.now.mesh)
        if state is not self._document.now:
            self._document.preview(state)

    def go_soon(self, record: RunRecord, number: int) -> None:
        """Show an iteration when the event loop is idle; of several calls only the last counts."""
        self._target = RecordedIteration(record, number)
        self._soon.start()

    def step(self, by: int) -> None:
        """Pause, and go forward by some recorded iterations, or backward if `by` is negative."""
        self.pause()
        self._go_by(by)

    def go_to_newest(self) -> None:
        """Show the newest iteration; if the run is active, also those that follow."""
        self.pause()
        if self._smoothing.busy and self.record is self._smoothing.record:
            self._smoothing.follow(True)
        elif self.record is not None:
            self.go(self.record, self.record.newest)

    def set_speed(self, speed: float) -> None:
        """Set the number of iterations played per second."""
        self.speed = speed
        self._clock.setInterval(round(1000 / speed))

    def play(self) -> None:
        """Play the recorded iterations from the shown one; at the end, from the start."""
        if self.record is None:
            return
        if self.shown_iteration is None or self.shown_iteration.number >= self.record.newest:
            self.go(self.record, 0)
        self._clock.start(round(1000 / self.speed))
        self.changed.emit()

    def pause(self) -> None:
        """Pause playing."""
        if self.playing:
            self._clock.stop()
            self.changed.emit()

    def choose(self, record: RunRecord) -> None:
        """Select another run, and show its result or newest iteration."""
        self.pause()
        self.record = record
        self.changed.emit()
        self.go(record, record.newest if record.result is None else record.result)

    def to_data(self) -> int | None:
        """Return the number of the selected run for a session file."""
        records = self.history.records
        return records.index(self.record) if self.record in records else None

    def restore(self, run: int | None) -> None:
        """Select the run with a number, of a session file; the history is restored first."""
        self.update_runs()
        if run is not None:
            self.record = self.history.records[run]
            self.changed.emit()

    def delete(self, record: RunRecord) -> None:
        """Delete a run, unless it is active."""
        if self._smoothing.busy and record is self._smoothing.record:
            return
        self.history.remove(record)
        self.update_runs()

    def update_runs(self) -> None:
        """Select the newest run if the selected one is gone, and tell what has changed in the history."""
        if self.record not in self.history.records:
            self.pause()
            self.record = self.history.records[-1] if self.history.records else None
        self._on_moved()
        if self._runs != self.history.records:
            self._runs = list(self.history.records)
            self.runs_changed.emit()
        self.changed.emit()

    def _go_by(self, by: int) -> None:
        if self.record is None:
            return
        numbers = self.history.recorded_numbers(self.record).tolist()
        shown = (
            self.shown_iteration.number
            if self.shown_iteration is not None and self.shown_iteration.record is self.record
            else 0
        )
        ahead = [n for n in numbers if n > shown] if by > 0 else [n for n in reversed(numbers) if n < shown]
        if ahead:
            self.go(self.record, ahead[min(abs(by), len(ahead)) - 1])

    def _play_next(self) -> None:
        before = self.shown_iteration
        self._go_by(1)
        if self.shown_iteration is before:
            self.pause()

    def _go_to_target(self) -> None:
        if self._target is not None and self._target.record in self.history.records:
            self.go(self._target.record, self._target.number)
        self._target = None

    def _on_moved(self) -> None:
        shown = self.history.iteration_of(self._document.now)
        if shown != self.shown_iteration:
            self.shown_iteration = shown
            if shown is not None and shown.number and shown.record is not self.record:
                self.record = shown.record
                self.changed.emit()
            self.moved.emit()

    def _on_mesh_replaced(self) -> None:
        self.pause()
        self.history.clear()
        self.update_runs()

    def _on_phase(self) -> None:
        if self._smoothing.phase in (Phase.PREPARING, Phase.RUNNING):
            self.pause()
        if self._smoothing.phase is Phase.PREPARING:
            self.record = self._smoothing.record
        self.update_runs()
