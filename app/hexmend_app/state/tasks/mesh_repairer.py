"""Repairing the mesh in a thread while the window stays alive."""

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
    """Repairs what the doctor finds; meanwhile the mesh is looked at, but not changed.

    Parameters
    ----------
    session : SessionParts

    Signals
    -------
    began
    ended(findings)
        A tuple of what was repaired; where it is not empty, the document holds the repaired mesh as one change.
    failed(Exception)
        The document is as it was.
    cancelled
        The document is as it was.
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
        """Begin to repair some kinds of problem, or all; whether the mesh may be changed now."""
        session = self._session
        if not session.editable:
            return False
        session.node_sweep.leave()
        self._before, self._kinds = before, kinds = session.document.now, tuple(kinds)
        self._task = Task(f"repairing {before.mesh.name}", lambda _: _repaired(before.mesh, kinds), yields=True)
        self._task.ended.connect(self._finish)
        self.began.emit()
        self._task.start()
        return True

    def cancel(self) -> None:
        """Leave the mesh as it is; what the thread still finds is dropped."""
        if self._task is not None:
            self._task.drop()
            self._before = self._task = None
            self.cancelled.emit()

    def close(self) -> None:
        """Ask the thread to end; nothing is repaired any more."""
        drop(self._task)
        self._task = None

    def _finish(self) -> None:
        task, self._task = self._task, None
        before, self._before = self._before, None
        if task.error is not None:
            self.failed.emit(task.error)
            return
        state, mended = task.result
        document = self._session.document
        if document.now is not before:  # another iteration has come into view
            self.cancelled.emit()
            return
        if mended:
            title = "mend " + " and ".join(PROBLEMS[one.kind].title.lower() for one in mended)
            document.commit(title, state)
            self._session.user_event.emit(MeshEdited(title, before, document.now, repair, (self._kinds,)))
        self.ended.emit(mended)


def _repaired(mesh: Mesh, kinds: Sequence[str]) -> tuple[State | None, tuple[Finding, ...]]:
    """A mesh repaired and measured, with what the view draws it from; None where nothing was repaired."""
    mesh, mended = repair(mesh, kinds)
    if not mended:
        return None, ()
    state = State.of(mesh.keeping_surface())
    _ = state.mesh.topology.face_neighbours, state.mesh.topology.layers
    return state, mended
