"""Iterations of a run in the document: as they come, eased into one another, or none."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QObject

from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from hexmend_app.state.run.eased_view import EasedView
from hexmend_app.state.run.pace import Pace
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
    pace : Pace
        Pace at which the iterations of runs are shown.
    eased : EasedView
        Shows iterations at the pace of that name.
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
        self._before: State | None = None
        self._emitting = False
        self.following = True
        self.pace = Pace.FASTEST
        self.eased = EasedView(document, history, self)

    @property
    def iterating(self) -> bool:
        """True while another iteration is shown and nothing else has changed."""
        return self._emitting or self.eased.advancing

    def begin(self, record: RunRecord, before: State, iterations: float) -> None:
        """Show the iterations of a run that begins, at the pace; one that pauses after some is not eased."""
        self._record, self._before, self.following = record, before, True
        if self.pace is Pace.EASED and math.isinf(iterations):
            self.eased.begin(record)

    def follow(self, on: bool) -> None:
        """Show iterations as they come, starting with the newest, or stop doing so."""
        self.eased.cancel()
        self.following = on
        self._show_newest()

    def skip_easing(self) -> None:
        """Show the newest iteration or the result at once, and those that follow as they come."""
        if self.eased.active:
            self.eased.skip()
            self._show_newest()

    def show(self, frame: IterationFrame, emit: Callable[[IterationFrame], object], *, alone: bool) -> None:
        """Show an iteration that has come and emit it; one at a breakpoint is always shown.

        Parameters
        ----------
        frame : IterationFrame
        emit : callable
        alone : bool
            Nothing else changes with the iteration.
        """
        self._emitting = alone and frame.hit is None
        if frame.hit is not None:
            self.eased.cancel()
            self.following = True
        if self.following and not self.eased.active:
            self._preview(frame)
        emit(frame)
        self._emitting = False

    def fail(self, title: str, last: IterationFrame | None) -> None:
        """Record the last iteration of a run that failed; without one, show the mesh before it."""
        self.eased.cancel()
        if last is None:
            self._document.preview(self._before)
        else:
            self._document.commit(title, last.state)

    def finish(self, title: str, last: IterationFrame | None) -> None:
        """Record the result of a run, and show it unless the user looks at an earlier iteration."""
        if last is not None:
            eased = self.following and self.eased.active
            self._document.commit(title, last.state, show=self.following and not eased)
            if eased:  # to the state that is recorded, which is that before the run if no iteration was better
                self.eased.finish(last.iteration.number, self._document.recorded)
        elif self.eased.active:
            self.eased.cancel()
            self._document.preview(self._before)

    def _show_newest(self) -> None:
        frame = self._newest()
        if self.following and frame is not None:
            self._preview(frame)

    def _preview(self, frame: IterationFrame) -> None:
        self._history.register_state(frame.state, RecordedIteration(self._record, frame.iteration.number))
        self._document.preview(frame.state)
