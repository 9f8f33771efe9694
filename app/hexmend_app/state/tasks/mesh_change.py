"""Changes of the mesh in the background, each one entry of the undo list: repair and padding."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import PROBLEMS, repair
from hexmend.mesh.mesh import Mesh
from hexmend.padding import pad
from hexmend_app.state.mesh.document import Command, State
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
    command : Command
        Call of the core that makes the same change.
    """

    outcome: Any
    title: str
    state: State | None
    command: Command


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
            document.commit(change.title, change.state, command=change.command)
        self.ended.emit(change.outcome)


def prepared_state(mesh: Mesh) -> State:
    """Measure a changed mesh and compute what the view needs to draw it."""
    state = State.of(mesh.keeping_surface())
    _ = state.mesh.topology.face_neighbours, state.mesh.topology.layers
    return state


class PaddingChoice(NamedTuple):
    """Options of a layer: the arguments of `hexmend.pad`.

    Parameters
    ----------
    name : str or None
        Set under whose faces the layer is laid.
    around : str or None
        Hexes around which it is laid, "locked" or "inverted"; without both it is under the whole boundary.
    rings : int
    thickness : float or None
        None for the default.
    """

    name: str | None = None
    around: str | None = None
    rings: int = 1
    thickness: float | None = None


class MeshPadder(BackgroundChange):
    """Lays a layer of hexes under the boundary and mends the mesh; `ended` sends a `hexmend.Padding`."""

    def start(self, choice: PaddingChoice) -> bool:
        """Start padding the mesh; return False if it is not editable."""
        return self._begin("padding", lambda before, task: _pad(before, choice, task))


def _pad(before: State, choice: PaddingChoice, task: Task) -> MeshChange:
    """Pad, mend, measure and prepare a mesh; mending ends when the task is cancelled."""
    padding = pad(before.mesh, *choice, progress=False, watch=lambda _: not task.cancelled.is_set())
    return MeshChange(padding, "pad", prepared_state(padding.mesh), Command("pad", (before,), tuple(choice)))


class MeshRepairer(BackgroundChange):
    """Repairs the problems of the mesh; `ended` sends those that were repaired, as a tuple of Finding."""

    def start(self, kinds: Sequence[str] = ()) -> bool:
        """Start repairing some kinds of problem, or all; return False if the mesh is not editable."""
        kinds = tuple(kinds)
        return self._begin("repairing", lambda before, _: _repair(before, kinds))


def _repair(before: State, kinds: tuple[str, ...]) -> MeshChange:
    """Repair, measure and prepare a mesh."""
    mesh, repaired = repair(before.mesh, kinds)
    title = "repair " + " and ".join(PROBLEMS[finding.kind].title.lower() for finding in repaired)
    return MeshChange(
        repaired, title, prepared_state(mesh) if repaired else None, Command("repair", (before,), (kinds,))
    )
