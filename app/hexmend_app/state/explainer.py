"""A node's step, worked out beside the window: a global method takes seconds for it on a large mesh."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.mesh import Mesh
from hexmend.node_step import NodeStep, explain
from hexmend.smoothers import Smoother
from hexmend_app.state.task import Task


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
    error : BaseException or None
    """

    answered = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.step: NodeStep | None = None
        self.error: BaseException | None = None
        self._wanted: tuple[Mesh, Smoother, int] | None = None
        self._asked: tuple[Mesh, Smoother, int] | None = None
        self._task: Task | None = None

    @property
    def busy(self) -> bool:
        """Whether an answer is to come."""
        return self._wanted is not None

    def ask(self, mesh: Mesh, smoother: Smoother, node: int) -> None:
        """Ask what the method would do to a free node; what was asked before is forgotten."""
        self.forget()
        self._wanted = mesh, smoother, node
        if self._task is None:
            self._begin()

    def forget(self) -> None:
        """Want no answer any more."""
        self._wanted = self.step = self.error = None

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is answered any more."""
        self.forget()
        if self._task is not None:
            self._task.wait()
            self._task = None

    def _begin(self) -> None:
        self._asked = question = self._wanted
        self._task = Task(f"reading the step of node {question[2]}", lambda _: explain(*question), yields=True)
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if self._wanted is None:
            return
        if self._asked != self._wanted:
            self._begin()
            return
        self._wanted = None
        self.step, self.error = task.result, task.error
        self.answered.emit()
