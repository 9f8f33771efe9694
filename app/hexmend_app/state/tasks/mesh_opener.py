"""Reading a mesh without holding up the window."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend_app.picture.picture_metadata import read_metadata
from hexmend_app.picture.png_text import is_png
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.session import session_data
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredPicture, restore_picture
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.tasks.task import Task


class LoadStage(Enum):
    """Stage of opening a mesh."""

    READING = "reading"
    MEASURING = "measuring"
    PREPARING = "preparing"


@dataclass(frozen=True)
class LoadProgress:
    """Progress of opening a file; `hexes` is 0 while their number is unknown."""

    doing: LoadStage
    path: Path
    hexes: int = 0


def _read_picture(wanting: MissingMesh, path: Path, task: Task) -> RestoredPicture:
    """Read the mesh that a picture shows, and look at it as the picture does; then the others that it shows."""
    opened = _read(path, task)
    states = [opened] if isinstance(opened, State) else opened.states()
    return restore_picture(wanting, path, states, lambda other: task.tell(LoadProgress(LoadStage.READING, other)))


def _open(path: Path, wanting: MissingMesh | None, task: Task) -> State | SessionData | RestoredPicture | MissingMesh:
    """Read a file; of a picture, the mesh that it shows."""
    if wanting is None and is_png(path):
        wanting = MissingMesh(path, read_metadata(path))
        found = wanting.metadata.first.candidates(path)
        if not found:
            return wanting
        path = found[0]
    return _read(path, task) if wanting is None else _read_picture(wanting, path, task)


def _read(path: Path, task: Task) -> State | SessionData:
    """Read, measure and prepare one mesh, and tell which of them has begun; what goes wrong is a `HexmendError`."""
    try:
        task.tell(LoadProgress(LoadStage.READING, path))
        if session_data.is_session_file(path):
            opened = session_data.read(path)
            mesh = opened.document.now.mesh
        else:
            mesh = read(path)
            task.tell(LoadProgress(LoadStage.MEASURING, path, mesh.n_hexes))
            opened = State.of(mesh)
        task.tell(LoadProgress(LoadStage.PREPARING, path, mesh.n_hexes))
        _ = mesh.topology.face_neighbours, mesh.topology.layers  # what the view draws from
    except HexmendError:
        raise
    except Exception as error:  # a reader that fails in a way of its own must not take the window down
        raise HexmendError(f"{path.name}: cannot be read ({type(error).__name__}: {error}).") from error
    return opened


class MeshOpener(QObject):
    """Opens meshes into the document, and sessions.

    Signals
    -------
    began(Path)
    told(Progress)
        What is being done now.
    loaded(SessionData, Path or None)
        A session was read: whoever has all its parts takes it, before `ended`. The path is None where it is taken up
        after a window's unexpected end.
    restored(Restored)
        A picture was opened, and its mesh is the document's: whoever looks at it does so as the picture has it, before
        `ended`.
    wanting(Wanting)
        A picture was opened whose mesh is not found: `open` takes it again, with the path of the mesh.
    ended(Path)
        The mesh is the document's.
    cancelled(Path)
        The document is as it was.
    failed(Path, Exception)
        The document is as it was.
    """

    began = Signal(object)
    progressed = Signal(object)
    loaded = Signal(object, object)
    restored = Signal(object)
    wanting = Signal(object)
    ended = Signal(object)
    cancelled = Signal(object)
    failed = Signal(object, object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._path: Path | None = None  # what is being read
        self._task: Task | None = None
        self._next: tuple[Path, bool, MissingMesh | None] | None = None
        self._recovers = False

    @property
    def busy(self) -> bool:
        """True while a mesh is being read."""
        return self._task is not None

    blocks_editing = busy

    def open(self, path: str | Path, *, recovers: bool = False, wanting: MissingMesh | None = None) -> None:
        """Begin to read; of several asked for while one is read, the last is opened next.

        Parameters
        ----------
        path : path-like
        recovers : bool
            It is a session that was written beside an open window: the mesh keeps the path of its own file, and is as
            little saved as it was.
        wanting : Wanting, optional
            A picture that shows the mesh, which is to be looked at as there.
        """
        path = Path(path)
        if self.busy:
            self._next = path, recovers, wanting
            return
        self._path, self._recovers = path, recovers
        self._task = Task(f"reading {path.name}", partial(_open, path, wanting))
        self._task.reported.connect(self.progressed)
        self._task.ended.connect(self._finish)
        self.began.emit(path)
        self._task.start()

    def cancel(self) -> None:
        """Stop waiting: a thread cannot be ended from outside, but what it reads is dropped, and others can be read."""
        if self._task is None:
            return
        task, self._task, self._next = self._task, None, None
        task.drop()
        self.cancelled.emit(self._path)

    def close(self) -> None:
        """Open nothing any more."""
        self.cancel()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if self._next is not None:
            (path, recovers, wanting), self._next = self._next, None
            self.open(path, recovers=recovers, wanting=wanting)
        elif task.error is not None:
            self.failed.emit(self._path, task.error)
        else:
            result = task.result
            if isinstance(result, MissingMesh):
                self.wanting.emit(result)
                return
            if isinstance(result, State):
                self._document.replace(result, self._path)
            elif isinstance(result, RestoredPicture):
                self._path = result.path
                self._document.replace(result.state, result.path)
                self.restored.emit(result)
            else:
                self._task = task  # busy until all have taken it: what they tell meanwhile is no event of the user's
                self.loaded.emit(result, None if self._recovers else self._path)
                self._task = None
            self.ended.emit(self._document.path if self._recovers and self._document.path else self._path)
