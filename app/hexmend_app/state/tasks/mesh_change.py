"""Changes of the mesh in the background, each one entry of the undo list: repair and padding."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import PROBLEMS, repair
from hexmend.mesh.mesh import Mesh
from hexmend.padding import pad
from hexmend_app.state.mesh.document import Command, Document, MeasuredMesh
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task


@dataclass(frozen=True, eq=False)
class MeshChange:
    """Result of a change.

    Parameters
    ----------
    outcome : object
        The result as the function of the core returns it.
    title : str
        Title in the undo list.
    state : MeasuredMesh or None
        The changed mesh; None if nothing was changed.
    command : Command
        Call of the core that makes the same change.
    """

    outcome: Any
    title: str
    state: MeasuredMesh | None
    command: Command


class MeshChanger(OneTask):
    """Changes the mesh, which can be viewed but not edited meanwhile.

    Parameters
    ----------
    document : Document

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

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._before: MeasuredMesh | None = None
        document.mesh_replaced.connect(self.cancel)

    def start(self, name: str, change: Callable[[MeasuredMesh, Task], MeshChange]) -> None:
        """Start a change of the mesh, which is editable, by a function of its state and the task."""
        self._before = before = self._document.now
        self._start(f"{name} {before.mesh.name}", lambda task: change(before, task), yields=True)
        self.began.emit()

    def cancel(self) -> None:
        """Cancel the change; the mesh is unchanged."""
        if self._task is not None:
            self.close()
            self.cancelled.emit()

    def _finish(self, task: Task) -> None:
        before, self._before, document = self._before, None, self._document
        if task.error is not None:
            self.failed.emit(task.error)
        elif document.now is not before:  # the user has gone to another iteration
            self.cancelled.emit()
        else:
            change: MeshChange = task.result
            if change.state is not None:
                document.commit(change.title, change.state, command=change.command)
            self.ended.emit(change.outcome)


def prepared_state(mesh: Mesh) -> MeasuredMesh:
    """Measure a changed mesh and compute what the view needs to draw it."""
    state = MeasuredMesh.of(mesh.keeping_surface())
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


def pad_mesh(before: MeasuredMesh, choice: PaddingChoice, task: Task) -> MeshChange:
    """Lay a layer of hexes under the boundary, and mend, measure and prepare the mesh; the outcome is a `Padding`.

    Mending ends when the task is cancelled.
    """
    padding = pad(before.mesh, *choice, progress=False, watch=lambda _: not task.cancelled.is_set())
    return MeshChange(padding, "pad", prepared_state(padding.mesh), Command("pad", (before,), tuple(choice)))


def repair_mesh(before: MeasuredMesh, kinds: Sequence[str]) -> MeshChange:
    """Repair, measure and prepare a mesh; the outcome is a tuple of the findings that were repaired."""
    mesh, repaired = repair(before.mesh, kinds)
    title = "repair " + " and ".join(PROBLEMS[finding.kind].title.lower() for finding in repaired)
    command = Command("repair", (before,), (tuple(kinds),))
    return MeshChange(repaired, title, prepared_state(mesh) if repaired else None, command)
