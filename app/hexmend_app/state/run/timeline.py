"""Position in the history, and navigation in it: to any iteration, step by step, or by playing."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from hexmend_app.state.run.run_controller import Phase, RunController
from hexmend_app.state.settings.settings import ITERATIONS_PLAYED

#: Iterations a second at which a run is played.
SPEED = ITERATIONS_PLAYED.default


@dataclass(frozen=True)
class TimelineData:
    """Data of the timeline in a session file: the selected run."""

    record: int | None


class Timeline(QObject):
    """Goes through the iterations of the open mesh's runs; whatever shows the document follows.

    Going to an iteration changes nothing that undo would take back. A method that is run there begins a run of its own:
    a branch.

    Attributes
    ----------
    record : Record or None
        The run that is gone through.
    speed : float
        Iterations that are played a second.

    Signals
    -------
    runs_changed
        There is another run, or one less.
    grown
        There are more iterations, or another run is gone through.
    moved
        Another iteration is shown, or none.
    playing_changed
    """

    runs_changed = Signal()
    extended = Signal()
    moved = Signal()
    playing_changed = Signal()

    def __init__(self, document: Document, smoothing: RunController, history: History, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._smoothing = smoothing
        self.history = history
        self.record: RunRecord | None = None
        self.speed: float = SPEED
        self._runs: list[RunRecord] = []
        self._shown: RecordedIteration | None = None
        self._wanted: RecordedIteration | None = None
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._go_where_wanted)
        self._clock = QTimer(self)
        self._clock.timeout.connect(self._play_on)
        document.mesh_replaced.connect(self._on_another)
        document.points_moved.connect(self._on_moved)
        smoothing.iterated.connect(lambda frame: self.extended.emit())
        smoothing.phase_changed.connect(self._on_phase)

    @property
    def moment(self) -> RecordedIteration | None:
        """The iteration that is shown; None where what is shown is none."""
        return self._shown

    @property
    def live(self) -> bool:
        """True if the selected run is active and its iterations are shown as they arrive."""
        return self._smoothing.busy and self._smoothing.following

    @property
    def playing(self) -> bool:
        """True while the iterations are played."""
        return self._clock.isActive()

    def go(self, record: RunRecord, number: int) -> None:
        """Show the iteration of a run that is nearest to one and still kept."""
        if self._smoothing.busy:
            newest = record is self._smoothing.record and number >= record.newest
            self._smoothing.follow(newest)
            if newest:
                return
        state = self.history.state(RecordedIteration(record, number), self._document.now.mesh)
        if state is not self._document.now:
            self._document.preview(state)

    def go_soon(self, record: RunRecord, number: int) -> None:
        """Go there as soon as there is nothing else to do: of many wishes only the last counts."""
        self._wanted = RecordedIteration(record, number)
        self._soon.start()

    def step(self, by: int) -> None:
        """Go so many kept iterations on, or back where `by` is below zero, and hold."""
        self.pause()
        self._continue(by)

    def go_to_newest(self) -> None:
        """Show the newest iteration, and, while the run goes on, those that come."""
        self.pause()
        if self._smoothing.busy and self.record is self._smoothing.record:
            self._smoothing.follow(True)
        elif self.record is not None:
            self.go(self.record, self.record.newest)

    def set_speed(self, speed: float) -> None:
        """Play so many iterations a second."""
        self.speed = speed
        self._clock.setInterval(round(1000 / speed))

    def play(self) -> None:
        """Show the kept iterations one after another from here on; at the end, from the start."""
        if self.record is None:
            return
        if self._shown is None or self._shown.number >= self.record.newest:
            self.go(self.record, 0)
        self._clock.start(round(1000 / self.speed))
        self.playing_changed.emit()

    def pause(self) -> None:
        """Pause playing."""
        if self.playing:
            self._clock.stop()
            self.playing_changed.emit()

    def choose(self, record: RunRecord) -> None:
        """Go through another run, from its result or its newest iteration on."""
        self.pause()
        self.record = record
        self.extended.emit()
        self.go(record, record.newest if record.result is None else record.result)

    def to_data(self) -> TimelineData:
        """Return the data for a session file."""
        records = self.history.records
        return TimelineData(records.index(self.record) if self.record in records else None)

    def restore(self, data: TimelineData) -> None:
        """Go through what a session has kept, once the history has its runs."""
        self._take_newest()
        if data.record is not None:
            self.record = self.history.records[data.record]
            self.extended.emit()

    def forget(self, record: RunRecord) -> None:
        """Keep a run no longer; not one that goes on."""
        if self._smoothing.busy and record is self._smoothing.record:
            return
        self.history.remove(record)
        self._take_newest()

    def _take_newest(self) -> None:
        if self.record not in self.history.records:
            self.pause()
            self.record = self.history.records[-1] if self.history.records else None
        self._on_moved()
        if self._runs != self.history.records:
            self._runs = list(self.history.records)
            self.runs_changed.emit()
        self.extended.emit()

    def _continue(self, by: int) -> None:
        if self.record is None:
            return
        numbers = self.history.kept(self.record).tolist()
        at = self._shown.number if self._shown is not None and self._shown.record is self.record else 0
        later = [n for n in numbers if n > at] if by > 0 else [n for n in reversed(numbers) if n < at]
        if later:
            self.go(self.record, later[min(abs(by), len(later)) - 1])

    def _play_on(self) -> None:
        before = self._shown
        self._continue(1)
        if self._shown is before:
            self.pause()

    def _go_where_wanted(self) -> None:
        if self._wanted is not None and self._wanted.record in self.history.records:
            self.go(self._wanted.record, self._wanted.number)
        self._wanted = None

    def _on_moved(self) -> None:
        shown = self.history.moment_of(self._document.now)
        if shown != self._shown:
            self._shown = shown
            if shown is not None and shown.number and shown.record is not self.record:
                self.record = shown.record
                self.extended.emit()
            self.moved.emit()

    def _on_another(self) -> None:
        self.pause()
        self.history.clear()
        self._take_newest()

    def _on_phase(self) -> None:
        if self._smoothing.phase in (Phase.PREPARING, Phase.RUNNING):
            self.pause()
        if self._smoothing.phase is Phase.PREPARING:
            self.record = self._smoothing.record
        self._take_newest()
