"""Shows short runs slowly enough for the eye: iterations that merge into one another."""

from __future__ import annotations

from time import perf_counter

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.history import History, RunRecord
from hexmend_app.state.run.pace import Easing

#: Milliseconds between two pictures.
_PERIOD = 33

#: Seconds of a run in which nothing is drawn, which would slow it down: the shortest are over by then.
_WAIT = 0.25

#: Most hexes of a mesh whose pictures can be drawn as often.
LIMIT = 150_000


class EasedView(QObject):
    """Shows the iterations of the active run, interpolated, in the document; then its result.

    The result is recorded in the document as soon as there is one, and is shown at once by `skip`.

    Attributes
    ----------
    active : bool
        True while iterations are shown.
    advancing : bool
        True while one is being shown.

    Signals
    -------
    active_changed
    """

    active_changed = Signal()

    def __init__(self, document: Document, history: History, parent: QObject | None = None):
        super().__init__(parent)
        self._document, self._history = document, history
        self.advancing = False
        self._record: RunRecord | None = None
        self._result: tuple[int, State] | None = None
        self._easing, self._began, self._at = Easing(0.0), 0.0, 0.0
        self._shown: State | None = None
        self._timer = QTimer(self, interval=_PERIOD, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._advance)
        document.points_moved.connect(self._on_moved)
        document.changes_changed.connect(self._on_changes)
        document.mesh_replaced.connect(self.cancel)

    @property
    def active(self) -> bool:
        return self._timer.isActive()

    def begin(self, record: RunRecord) -> None:
        """Show the iterations of a run that begins on the mesh of the document."""
        self.cancel()
        if self._document.now.mesh.n_hexes <= LIMIT:
            self._record, self._result = record, None
            self._began = perf_counter()
            self._easing, self._shown, self._at = Easing(self._began), self._document.now, 0.0
            self._timer.start()
            self.active_changed.emit()

    def finish(self, number: int, state: State) -> None:
        """Go on to the result of the run, which is over."""
        self._result = number, state
        self._easing.finish(perf_counter())

    def cancel(self) -> None:
        """Show no more; the document is left as it is."""
        if self.active:
            self._timer.stop()
            self._record = self._shown = None
            self.active_changed.emit()

    def skip(self) -> None:
        """Show the result of the run at once, or its newest iteration by the run itself."""
        if self.active:
            result = self._result
            self.cancel()
            if result is not None:
                self._document.preview(result[1])

    def _advance(self) -> None:
        now, record = perf_counter(), self._record
        if self._result is None:
            if now - self._began < _WAIT:
                return
            at = self._easing.position(now, record.newest) if record.rows else 0.0
        else:
            at = self._easing.rest(now, self._result[0])
        if at is None:
            self.skip()
        elif at != self._at:
            self._at = at
            self._shown = self._history.state_between(record, at, self._document.now.mesh)
            self.advancing = True
            self._document.preview(self._shown)
            self.advancing = False

    def _on_changes(self) -> None:
        """End where the result is no longer the last change, as after undo."""
        if self.active and self._result is not None and self._document.recorded is not self._result[1]:
            self.cancel()

    def _on_moved(self) -> None:
        """Leave the document to whoever else shows something in it."""
        if self.active and self._document.now is not self._shown:
            self.cancel()
