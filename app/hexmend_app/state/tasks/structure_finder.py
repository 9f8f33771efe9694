"""The structure of the open mesh, found beside the window: a fifth of a second at a million elements."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.structure import Structure, find_structure
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.tasks.task import Task, drop

#: Milliseconds after which the search begins: the mesh is to be seen first.
_PATIENCE = 100


class StructureFinder(QObject):
    """Knows the structure of the document's mesh, some time after it was opened.

    Signals
    -------
    found
        It is known now.
    """

    found = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._mesh: Mesh | None = None  # whose structure is being found
        self._task: Task | None = None
        self.structure: Structure | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(_PATIENCE)
        self._soon.timeout.connect(self.search)
        document.mesh_replaced.connect(self._wait)

    @property
    def busy(self) -> bool:
        """True while the search is in progress."""
        return self._task is not None

    def close(self) -> None:
        """Ask the thread to end; nothing is found any more."""
        self._document.mesh_replaced.disconnect(self._wait)
        self._soon.stop()
        drop(self._task)
        self._task = None

    def _wait(self) -> None:
        self.structure = None
        if self._task is None:  # or else as soon as that of the mesh before is found
            self._soon.start()

    def search(self) -> None:
        """Begin now, or when that of the mesh before is found; it happens by itself soon after a mesh was opened."""
        self._soon.stop()
        if self._task is not None:
            return
        self._mesh = mesh = self._document.start.mesh
        self._task = Task(f"reading {mesh.name}: its structure", lambda _: find_structure(mesh))
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if task.error is not None:
            raise task.error
        if self._mesh.topology is not self._document.start.mesh.topology:
            self.search()
        else:
            self.structure = task.result
            self.found.emit()
