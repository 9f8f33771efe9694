"""The structure of the open mesh, found beside the window: a fifth of a second at a million elements."""

from __future__ import annotations

from PySide6.QtCore import QObject, QThread, QTimer, Signal

from hexmend.mesh import Mesh
from hexmend.structure import Structure, structure
from hexmend_app.state.document import Document

#: Milliseconds after which the search begins: the mesh is to be seen first.
_PATIENCE = 100


class _Finding(QThread):
    """Finds the structure of one mesh."""

    def __init__(self, mesh: Mesh):
        super().__init__()
        self.setObjectName(f"reading {mesh.name}: its structure")
        self.mesh = mesh
        self.structure: Structure | None = None

    def run(self) -> None:
        """What the thread does."""
        self.structure = structure(self.mesh)


class Finder(QObject):
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
        self._finding: _Finding | None = None
        self.structure: Structure | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(_PATIENCE)
        self._soon.timeout.connect(self._begin)
        document.mesh_replaced.connect(self._wait)

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is found any more."""
        self._document.mesh_replaced.disconnect(self._wait)
        self._soon.stop()
        if self._finding is not None:
            self._finding.finished.disconnect(self._finish)
            self._finding.wait()
            self._finding = None

    def _wait(self) -> None:
        self.structure = None
        if self._finding is None:  # or else as soon as that of the mesh before is found
            self._soon.start()

    def _begin(self) -> None:
        self._finding = _Finding(self._document.start.mesh)
        self._finding.finished.connect(self._finish)
        self._finding.start()

    def _finish(self) -> None:
        finding, self._finding = self._finding, None
        if finding is None:
            return  # it was waited for, while this was on its way
        finding.wait()
        if finding.mesh.topology is not self._document.start.mesh.topology:
            self._begin()
        else:
            self.structure = finding.structure
            self.found.emit()
