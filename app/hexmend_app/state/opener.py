"""Reading a mesh without holding up the window."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QThread, Signal

from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend_app.state.document import Document, State


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
        except HexmendError as error:
            self.error = error
        except Exception as error:  # a reader that fails in a way of its own must not take the window down
            self.error = HexmendError(f"{self.path.name}: cannot be read ({type(error).__name__}: {error}).")


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
        self._next: Path | None = None
        self._dropped: list[_Reading] = []

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
        self.began.emit(self._reading.path)
        self._reading.start()

    def cancel(self) -> None:
        """Stop waiting: a thread cannot be ended from outside, but what it reads is dropped, and others can be read."""
        if self._reading is None:
            return
        reading, self._reading, self._next = self._reading, None, None
        reading.began.disconnect(self.told)
        self._dropped.append(reading)
        self.cancelled.emit(reading.path)

    def shut_down(self) -> None:
        """Wait until the thread is gone; nothing is opened any more."""
        self.cancel()
        for reading in self._dropped:
            reading.finished.disconnect(self._finish)
            reading.wait()
        self._dropped.clear()

    def _finish(self) -> None:
        for dropped in [one for one in self._dropped if one.isFinished()]:
            dropped.wait()
            self._dropped.remove(dropped)
        if self._reading is None or not self._reading.isFinished():
            return  # what has finished was dropped
        reading, self._reading = self._reading, None
        reading.wait()
        if self._next is not None:
            path, self._next = self._next, None
            self.open(path)
        elif reading.error is not None:
            self.failed.emit(reading.path, reading.error)
        else:
            self._document.replace(reading.state, reading.path)
            self.ended.emit(reading.path)
