"""Reading a mesh without holding up the window."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QThread, QTimer, Signal

from hexmend import compiling
from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend.mesh import Mesh
from hexmend.quality import element, node
from hexmend_app.state.binning import bin_counts
from hexmend_app.state.document import Document, State

#: Milliseconds between two looks at whether kernels are being compiled.
_PERIOD = 200


class _Reading(QThread):
    """Reads, measures and prepares one mesh.

    Signals
    -------
    began(str)
        The next part of the work has begun; says which.
    """

    began = Signal(str)

    def __init__(self, path: Path):
        super().__init__()
        self.setObjectName(f"reading {path.name}")
        self.path = path
        self.state: State | None = None
        self.error: Exception | None = None

    def run(self) -> None:
        """What the thread does."""
        try:
            self.began.emit(f"Reading {self.path.name}…")
            mesh = read(self.path)
            self.began.emit(f"Measuring {self.path.name}, {mesh.n_hexes:,} hexes…")
            self.state = State.of(mesh)
            self.began.emit(f"Preparing the view of {self.path.name}…")
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
    told(str)
        What is being done now.
    ended(Path)
        The mesh is the document's.
    cancelled(Path)
        The document is as it was.
    failed(Path, Exception)
        The document is as it was.
    """

    began = Signal(object)
    told = Signal(str)
    ended = Signal(object)
    cancelled = Signal(object)
    failed = Signal(object, object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._reading: _Reading | None = None
        self._preparing: _Preparing | None = None
        self._next: Path | None = None
        self._dropped: list[_Reading] = []
        self._compiled = 0
        self._look = QTimer(self)
        self._look.setInterval(_PERIOD)
        self._look.timeout.connect(self._look_for_kernels)

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
        self._reading.began.connect(self.told)
        self._compiled = compiling.begun
        self._look.start()
        self.began.emit(self._reading.path)
        self._reading.start()

    def cancel(self) -> None:
        """Stop waiting: a thread cannot be ended from outside, but what it reads is dropped, and others can be read."""
        if self._reading is None:
            return
        reading, self._reading, self._next = self._reading, None, None
        self._look.stop()
        reading.began.disconnect(self.told)
        self._dropped.append(reading)
        self.cancelled.emit(reading.path)

    def _look_for_kernels(self) -> None:
        if compiling.begun > self._compiled:
            self._look.stop()
            self.told.emit("Compiling what meshes are measured with, which takes up to a minute, once…")

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is opened any more."""
        self.cancel()
        for reading in self._dropped:
            reading.finished.disconnect(self._finish)
            reading.wait()
        self._dropped.clear()
        if self._preparing is not None:
            self._preparing.wait()
            self._preparing = None

    def _finish(self) -> None:
        for dropped in [one for one in self._dropped if one.isFinished()]:
            dropped.wait()
            self._dropped.remove(dropped)
        if self._reading is None or not self._reading.isFinished():
            return  # what has finished was dropped
        reading, self._reading = self._reading, None
        reading.wait()
        self._look.stop()
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
