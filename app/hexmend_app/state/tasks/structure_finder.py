"""Search for the structure of the open mesh in the background: 0.2 s for a million hexes."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend.mesh.mesh import Mesh
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.structure import MeshStructure, find_structure
from hexmend_app.state.tasks.task import Task, drop

#: Milliseconds from opening a mesh to the search: the mesh is drawn first.
_DELAY = 100


class StructureFinder(QObject):
    """Finds the structure of the open mesh, shortly after it is opened.

    Signals
    -------
    found
        `structure` is known.

    Attributes
    ----------
    structure : MeshStructure or None
        None while unknown.
    """

    found = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._mesh: Mesh | None = None  # the mesh that is being searched
        self._task: Task | None = None
        self.structure: MeshStructure | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(_DELAY)
        self._soon.timeout.connect(self.search)
        document.mesh_replaced.connect(self._wait)

    @property
    def busy(self) -> bool:
        """True while the search is in progress."""
        return self._task is not None

    def close(self) -> None:
        """Cancel the search."""
        self._document.mesh_replaced.disconnect(self._wait)
        self._soon.stop()
        drop(self._task)
        self._task = None

    def _wait(self) -> None:
        self.structure = None
        if self._task is None:  # otherwise the search starts when the present one ends
            self._soon.start()

    def search(self) -> None:
        """Start the search now, or when a search in the previous mesh has ended."""
        self._soon.stop()
        if self._task is not None:
            return
        self._mesh = mesh = self._document.start.mesh
        self._task = Task(f"finding the structure of {mesh.name}", lambda _: find_structure(mesh))
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if self._mesh.topology is not self._document.start.mesh.topology:
            self.search()
        elif task.error is not None:
            raise task.error
        else:
            self.structure = task.result
            self.found.emit()
