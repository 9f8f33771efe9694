"""Search for the structure of the open mesh in the background: 0.2 s for a million hexes."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.structure import find_structure
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task

#: Milliseconds from opening a mesh to the search: the mesh is drawn first.
_DELAY = 100


class StructureFinder(LatestTask):
    """Finds the structure of the open mesh, a `MeshStructure`, shortly after it is opened."""

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__("finding the structure", find_structure, parent)
        self._document = document
        self._soon = QTimer(self, singleShot=True, interval=_DELAY)
        self._soon.timeout.connect(self.search)
        document.mesh_replaced.connect(self._wait)

    def close(self) -> None:
        """Cancel the search."""
        self._document.mesh_replaced.disconnect(self._wait)
        self._soon.stop()
        super().close()

    def _wait(self) -> None:
        self.forget()
        self._soon.start()

    def search(self) -> None:
        """Start the search now, or when a search in the previous mesh has ended."""
        self._soon.stop()
        self.ask(self._document.start.mesh)

    def _finish(self, task: Task) -> None:
        super()._finish(task)
        if self.error is not None:
            raise self.error
