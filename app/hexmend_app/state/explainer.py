"""A node's step, worked out beside the window: a global method takes seconds for it on a large mesh."""

from __future__ import annotations

from PySide6.QtCore import QObject, QThread, Signal

from hexmend.mesh import Mesh
from hexmend.node_step import NodeStep, explain
from hexmend.smoothers import Smoother
from hexmend_app.state.standing_back import stand_back


class _Explaining(QThread):
    """Works out one step."""

    def __init__(self, mesh: Mesh, smoother: Smoother, node: int):
        super().__init__()
        self.setObjectName(f"reading the step of node {node}")
        self.question = mesh, smoother, node
        self.step: NodeStep | None = None
        self.error: Exception | None = None

    def run(self) -> None:
        """What the thread does; everything that goes wrong ends in `error`."""
        try:
            stand_back()
            self.step = explain(*self.question)
        except Exception as error:  # whatever it is, the window has to say it
            self.error = error


class Explainer(QObject):
    """Answers what a method would do to a node; of several questions, the newest.

    Signals
    -------
    answered
        `step` is known, or `error` says why it is not.

    Attributes
    ----------
    step : NodeStep or None
        The answer; None while there is none.
    error : Exception or None
    """

    answered = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.step: NodeStep | None = None
        self.error: Exception | None = None
        self._wanted: tuple[Mesh, Smoother, int] | None = None
        self._explaining: _Explaining | None = None

    @property
    def busy(self) -> bool:
        """Whether an answer is to come."""
        return self._wanted is not None

    def ask(self, mesh: Mesh, smoother: Smoother, node: int) -> None:
        """Ask what the method would do to a free node; what was asked before is forgotten."""
        self.forget()
        self._wanted = mesh, smoother, node
        if self._explaining is None:
            self._begin()

    def forget(self) -> None:
        """Want no answer any more."""
        self._wanted = self.step = self.error = None

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is answered any more."""
        self.forget()
        if self._explaining is not None:
            self._explaining.finished.disconnect(self._finish)
            self._explaining.wait()
            self._explaining = None

    def _begin(self) -> None:
        self._explaining = _Explaining(*self._wanted)
        self._explaining.finished.connect(self._finish)
        self._explaining.start()

    def _finish(self) -> None:
        done, self._explaining = self._explaining, None
        if done is None:
            return  # it was waited for, while this was on its way
        done.wait()
        if self._wanted is None:
            return
        if done.question != self._wanted:
            self._begin()
            return
        self._wanted = None
        self.step, self.error = done.step, done.error
        self.answered.emit()
