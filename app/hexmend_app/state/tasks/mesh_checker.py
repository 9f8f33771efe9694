"""Check of the open mesh for problems, in the background."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import Finding, examine
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task


class MeshChecker(LatestTask):
    """Checks a mesh in the background; only the latest request counts.

    Signals
    -------
    found
        The findings or `error` have changed.

    Attributes
    ----------
    error : BaseException or None
        Error of the last check, if it failed.
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
        """Request a check of a mesh, unless this was the last request."""
        if self._latest is None or self._latest[0] is not mesh:
            self._submit((mesh,))

    def _make_task(self, request: tuple[Mesh]) -> Task:
        self.error = None
        return Task(f"checking {request[0].name}", lambda _: examine(request[0]))

    def _on_result(self, task: Task) -> None:
        self._findings, self.error, self._mesh = task.result, task.error, self._latest[0]
        self.found.emit()
