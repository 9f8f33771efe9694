"""Computation of a node's step in the background: for a global method on a large mesh it takes seconds."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.smoothers import Smoother
from hexmend_app.state.node_step import NodeStep, explain
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task


class NodeStepTask(LatestTask):
    """Computes the step that a method would make with a node; only the latest request counts.

    Signals
    -------
    answered
        The request has ended: `step` or `error` is set.

    Attributes
    ----------
    step : NodeStep or None
        None while unknown.
    error : BaseException or None
        Error of the computation, if it failed.
    """

    answered = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.step: NodeStep | None = None
        self.error: BaseException | None = None

    @property
    def busy(self) -> bool:
        """True while a request is pending."""
        return self._latest is not None

    def ask(self, mesh: Mesh, smoother: Smoother, node: int) -> None:
        """Request the step of a free node; the previous request is cancelled."""
        self.forget()
        self._submit((mesh, smoother, node))

    def forget(self) -> None:
        """Cancel; pending results are dropped."""
        self._latest = self.step = self.error = None

    def _make_task(self, request: tuple[Mesh, Smoother, int]) -> Task:
        return Task(f"computing the step of node {request[2]}", lambda _: explain(*request), yields=True)

    def _on_result(self, task: Task) -> None:
        self._latest = None
        self.step, self.error = task.result, task.error
        self.answered.emit()
