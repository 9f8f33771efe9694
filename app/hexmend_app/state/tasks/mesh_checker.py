"""Check of the open mesh for problems, in the background."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import Finding, examine
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task


class MeshChecker(LatestTask):
    """Examines a mesh; of several that it was asked for, the newest.

    Signals
    -------
    found
        There are other findings, or there is an `error`.

    Attributes
    ----------
    error : BaseException or None
        Why the mesh that was asked for last could not be examined; None before that is known.
    """

    found = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._findings: tuple[Finding, ...] | None = None
        self._mesh: Mesh | None = None
        self.error: BaseException | None = None

    def of(self, mesh: Mesh) -> tuple[Finding, ...] | None:
        """Return the problems of a mesh; None while they are unknown."""
        return self._findings if self._mesh is mesh else None

    def ask(self, mesh: Mesh) -> None:
        """Examine a mesh, unless that is done or being done, or has failed."""
        if self._wanted is None or self._wanted[0] is not mesh:
            self._want((mesh,))

    def _work(self, question: tuple[Mesh]) -> Task:
        self.error = None
        return Task(f"examining {question[0].name}", lambda _: examine(question[0]))

    def _take(self, task: Task) -> None:
        self._findings, self.error, self._mesh = task.result, task.error, self._wanted[0]
        self.found.emit()
