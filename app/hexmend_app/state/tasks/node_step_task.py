"""A node's step, worked out beside the window: a global method takes seconds for it on a large mesh."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.node_step import NodeStep, explain
from hexmend.smoothers import Smoother
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task


class NodeStepTask(LatestTask):
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

    @property
    def busy(self) -> bool:
        """True while an answer is pending."""
        return self._wanted is not None

    def ask(self, mesh: Mesh, smoother: Smoother, node: int) -> None:
        """Ask what the method would do to a free node; what was asked before is forgotten."""
        self.forget()
        self._want((mesh, smoother, node))

    def forget(self) -> None:
        """Want no answer any more."""
        self._wanted = self.step = self.error = None

    def _work(self, question: tuple[Mesh, Smoother, int]) -> Task:
        return Task(f"reading the step of node {question[2]}", lambda _: explain(*question), yields=True)

    def _take(self, task: Task) -> None:
        self._wanted = None
        self.step, self.error = task.result, task.error
        self.answered.emit()
