"""Changes of the mesh in the background, each one entry of the undo list."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend_app.state.mesh.document import Edit, State
from hexmend_app.state.tasks.task import Task, drop

if TYPE_CHECKING:
    from hexmend_app.state.session.session_parts import SessionParts


@dataclass(frozen=True, eq=False)
class MeshChange:
    """Result of a change.

    Parameters
    ----------
    outcome : object
        The result as the function of the core returns it.
    title : str
        Title in the undo list.
    state : State or None
        The changed mesh; None if nothing was changed.
    edit : Edit
        Call of the core that makes the same change.
    """

    outcome: Any
    title: str
    state: State | None
    edit: Edit


class BackgroundChange(QObject):
    """Changes the mesh, which can be viewed but not edited meanwhile; a base class.

    Parameters
    ----------
    session : SessionParts

    Signals
    -------
    began
    ended(object)
        The outcome of the change; if the mesh has changed, the document has the new mesh as one change.
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
        self._task: Task | None = None
        session.document.mesh_replaced.connect(self.cancel)

    @property
    def busy(self) -> bool:
        """True while the mesh is being changed."""
        return self._task is not None

    def _begin(self, name: str, change: Callable[[State, Task], MeshChange]) -> bool:
        """Start a change of the mesh by a function of its state and the task; return False if it is not editable."""
        session = self._session
        if not session.editable:
            return False
        session.end_previews()
        self._before = before = session.document.now
        self._task = Task(f"{name} {before.mesh.name}", lambda task: change(before, task), yields=True)
        self._task.ended.connect(self._finish)
        self.began.emit()
        self._task.start()
        return True

    def cancel(self) -> None:
        """Cancel the change; the mesh is unchanged."""
        if self._task is not None:
            self._task.drop()
            self._before = self._task = None
            self.cancelled.emit()

    def close(self) -> None:
        """Cancel the change without a signal: the window closes."""
        drop(self._task)
        self._task = None

    def _finish(self) -> None:
        task, self._task = self._task, None
        before, self._before = self._before, None
        if task.error is not None:
            self.failed.emit(task.error)
            return
        change: MeshChange = task.result
        document = self._session.document
        if document.now is not before:  # the user has gone to another iteration
            self.cancelled.emit()
            return
        if change.state is not None:
            document.commit(change.title, change.state, edit=change.edit)
        self.ended.emit(change.outcome)


def prepared_state(mesh: Mesh) -> State:
    """Measure a changed mesh and compute what the view needs to draw it."""
    state = State.of(mesh.keeping_surface())
    _ = state.mesh.topology.face_neighbours, state.mesh.topology.layers
    return state
