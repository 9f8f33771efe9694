"""Shows the iterations of a run in the document."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject

from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from hexmend_app.state.run.worker import IterationFrame


class RunView(QObject):
    """Shows the iterations of the active run in the document, then its result.

    Parameters
    ----------
    document : Document
    history : History
    newest : callable
        Returns the newest iteration of the active run, as an IterationFrame; None if there is none.

    Attributes
    ----------
    following : bool
        True if iterations are shown as they come; False while the user looks at earlier ones.
    iterating : bool
        True while another iteration is shown and nothing else has changed.
    """

    def __init__(
        self,
        document: Document,
        history: History,
        newest: Callable[[], IterationFrame | None],
        parent: QObject | None = None,
    ):
        super().__init__(parent)
        self._document, self._history, self._newest = document, history, newest
        self._record: RunRecord | None = None
        self.following = True
        self.iterating = False

    def begin(self, record: RunRecord) -> None:
        """Show the iterations of a run that begins."""
        self._record, self.following = record, True

    def follow(self, on: bool) -> None:
        """Show iterations as they come, starting with the newest, or stop doing so."""
        self.following = on
        newest = self._newest()
        if on and newest is not None:
            self._preview(newest)

    def show(self, frame: IterationFrame, emit: Callable[[IterationFrame], object], *, alone: bool) -> None:
        """Show an iteration that has come and emit it; one at a breakpoint is always shown.

        Parameters
        ----------
        frame : IterationFrame
        emit : callable
        alone : bool
            Nothing else changes with the iteration.
        """
        self.iterating = alone and frame.hit is None
        if frame.hit is not None:
            self.following = True
        if self.following:
            self._preview(frame)
        emit(frame)
        self.iterating = False

    def fail(self, title: str, last: IterationFrame | None) -> None:
        """Record and show the last iteration of a run that failed, if there is one."""
        if last is not None:
            self._document.commit(title, last.state)

    def finish(self, title: str, last: IterationFrame | None) -> None:
        """Record the result of a run, and show it unless the user looks at an earlier iteration."""
        if last is not None:
            self._document.commit(title, last.state, show=self.following)

    def _preview(self, frame: IterationFrame) -> None:
        self._history.register_state(frame.state, RecordedIteration(self._record, frame.iteration.number))
        self._document.preview(frame.state)
