"""Reading a mesh without holding up the window."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QThread, Signal

from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend.mesh import Mesh
from hexmend.quality import element, node
from hexmend_app.state.binning import bin_counts
from hexmend_app.state.document import Document, State


class _Reading(QThread):
    """Reads, measures and prepares one mesh."""

    def __init__(self, path: Path):
        super().__init__()
        self.setObjectName(f"reading {path.name}")
        self.path = path
        self.state: State | None = None
        self.error: Exception | None = None

    def run(self) -> None:
        """What the thread does."""
        try:
            self.state = State.of(read(self.path))
            _ = self.state.mesh.topology.face_neighbours, self.state.mesh.topology.layers  # what the view draws from
            bin_counts(self.state.figures.q, self.state.figures.inverted, (0.0, 1.0), 1)  # compiled here the first time
        except HexmendError as error:
            self.error = error
        except Exception as error:  # a reader that fails in a way of its own must not take the window down
            self.error = HexmendError(f"{self.path.name}: cannot be read ({type(error).__name__}: {error}).")


class _Preparing(QThread):
    """Loads what a click on an element needs: kernels that are compiled the first time, while the mesh is seen."""

    def __init__(self, mesh: Mesh):
        super().__init__()
        self.setObjectName(f"reading {mesh.name}: what a click needs")
        self._mesh = mesh

    def run(self) -> None:
        """What the thread does."""
        element(self._mesh, 0)
        node(self._mesh, int(self._mesh.hexes[0, 0]))


class Opener(QObject):
    """Opens meshes into the document.

    Signals
    -------
    began(Path)
    ended(Path)
        The mesh is the document's.
    failed(Path, Exception)
        The document is as it was.
    """

    began = Signal(object)
    ended = Signal(object)
    failed = Signal(object, object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._reading: _Reading | None = None
        self._preparing: _Preparing | None = None
        self._next: Path | None = None

    @property
    def busy(self) -> bool:
        """Whether a mesh is being read."""
        return self._reading is not None

    def open(self, path: str | Path) -> None:
        """Begin to read; of several asked for while one is read, the last is opened next."""
        if self.busy:
            self._next = Path(path)
            return
        self._reading = _Reading(Path(path))
        self._reading.finished.connect(self._finish)
        self.began.emit(self._reading.path)
        self._reading.start()

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is opened any more."""
        self._next = None
        if self._reading is not None:
            self._reading.finished.disconnect(self._finish)
            self._reading.wait()
            self._reading = None
        if self._preparing is not None:
            self._preparing.wait()
            self._preparing = None

    def _finish(self) -> None:
        reading, self._reading = self._reading, None
        reading.wait()
        if self._next is not None:
            path, self._next = self._next, None
            self.open(path)
        elif reading.error is not None:
            self.failed.emit(reading.path, reading.error)
        else:
            self._document.replace(reading.state, reading.path)
            if self._preparing is None:
                self._preparing = _Preparing(reading.state.mesh)
                self._preparing.start()
            self.ended.emit(reading.path)
