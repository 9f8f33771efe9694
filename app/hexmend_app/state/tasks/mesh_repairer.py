"""Repair of the mesh in the background."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import PROBLEMS, Finding, repair
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.user_events import MeshEdited
from hexmend_app.state.tasks.task import Task, drop

if TYPE_CHECKING:
    from hexmend_app.state.session.session_parts import SessionParts


class MeshRepairer(QObject):
    """Repairs the problems of the mesh, which can be viewed but not edited meanwhile.

    Parameters
    ----------
    session : SessionParts

    Signals
    -------
    began
    ended(tuple of Finding)
        The problems that were repaired; if there are any, the document has the repaired mesh as one change.
    failed(Exception)
        The document is unchanged.
    cancelled
        The document is unchanged.
    """

    began = Signal()
    ended = Signal(object)
    failed = Signal(object)
    cancelled = Signal()

    def __init__(self, session: SessionParts):
        super().__init__(session)
        self._session = session
        self._before: State | None = None
        self._kinds: tuple[str, ...] = ()
        self._task: Task | None = None
        session.document.mesh_replaced.connect(self.cancel)

    @property
    def busy(self) -> bool:
        """True while the mesh is being repaired."""
        return self._task is not None

    blocks_editing = busy

    def start(self, kinds: Sequence[str] = ()) -> bool:
        """Start repairing some kinds of problem, or all; return False if the mesh is not editable."""
        session = self._session
        if not session.editable:
            return False
        session.node_sweep.leave()
        self._before, self._kinds = before, kinds = session.document.now, tuple(kinds)
        self._task = Task(f"repairing {before.mesh.name}", lambda _: _repair(before.mesh, kinds), yields=True)
        self._task.ended.connect(self._finish)
        self.began.emit()
        self._task.start()
        return True

    def cancel(self) -> None:
        """Cancel the repair; the mesh is unchanged."""
        if self._task is not None:
            self._task.drop()
            self._before = self._task = None
            self.cancelled.emit()

    def close(self) -> None:
        """Cancel the repair without a signal: the window closes."""
        drop(self._task)
        self._task = None

    def _finish(self) -> None:
        task, self._task = self._task, None
        before, self._before = self._before, None
        if task.error is not None:
            self.failed.emit(task.error)
            return
        state, repaired = task.result
        document = self._session.document
        if document.now is not before:  # the user has gone to another iteration
            self.cancelled.emit()
            return
        if repaired:
            title = "repair " + " and ".join(PROBLEMS[finding.kind].title.lower() for finding in repaired)
            document.commit(title, state)
            self._session.user_event.emit(MeshEdited(title, before, document.now, repair, (self._kinds,)))
        self.ended.emit(repaired)


def _repair(mesh: Mesh, kinds: Sequence[str]) -> tuple[State | None, tuple[Finding, ...]]:
    """Repair, measure and prepare a mesh; return its state, None if nothing was repaired, and the repaired problems."""
    mesh, repaired = repair(mesh, kinds)
    if not repaired:
        return None, ()
    state = State.of(mesh.keeping_surface())
    _ = state.mesh.topology.face_neighbours, state.mesh.topology.layers  # the view needs them to draw
    return state, repaired
