"""Reading a mesh without holding up the window."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend_app.state import session_data
from hexmend_app.state.document import Document, State
from hexmend_app.state.restoring import Restored, Wanting, restored
from hexmend_app.state.scene.carried import read_carried
from hexmend_app.state.scene.png import is_png
from hexmend_app.state.session_data import SessionData
from hexmend_app.state.task import Task


class Doing(Enum):
    """What is being done to a mesh that is opened."""

    READING = "reading"
    MEASURING = "measuring"
    PREPARING = "preparing"


@dataclass(frozen=True)
class Progress:
    """How far the opening of a file is; `hexes` is 0 as long as nobody knows."""

    doing: Doing
    path: Path
    hexes: int = 0


def _read_picture(wanting: Wanting, path: Path, task: Task) -> Restored:
    """Read the mesh that a picture shows, and look at it as the picture does; then the others that it shows."""
    opened = _read(path, task)
    states = [opened] if isinstance(opened, State) else opened.states()
    return restored(wanting, path, states, lambda other: task.tell(Progress(Doing.READING, other)))


def _open(path: Path, wanting: Wanting | None, task: Task) -> State | SessionData | Restored | Wanting:
    """What a file holds; of a picture, the mesh that it shows."""
    if wanting is None and is_png(path):
        wanting = Wanting(path, read_carried(path))
        found = wanting.carried.first.candidates(path)
        if not found:
            return wanting
        path = found[0]
    return _read(path, task) if wanting is None else _read_picture(wanting, path, task)


def _read(path: Path, task: Task) -> State | SessionData:
    """Read, measure and prepare one mesh, and tell which of them has begun; what goes wrong is a `HexmendError`."""
    try:
        task.tell(Progress(Doing.READING, path))
        if session_data.is_session_file(path):
            opened = session_data.read(path)
            mesh = opened.document.now.mesh
        else:
            mesh = read(path)
            task.tell(Progress(Doing.MEASURING, path, mesh.n_hexes))
            opened = State.of(mesh)
        task.tell(Progress(Doing.PREPARING, path, mesh.n_hexes))
        _ = mesh.topology.face_neighbours, mesh.topology.layers  # what the view draws from
    except HexmendError:
        raise
    except Exception as error:  # a reader that fails in a way of its own must not take the window down
        raise HexmendError(f"{path.name}: cannot be read ({type(error).__name__}: {error}).") from error
    return opened


class Opener(QObject):
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
    told = Signal(object)
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
        self._next: tuple[Path, bool, Wanting | None] | None = None
        self._recovers = False

    @property
    def busy(self) -> bool:
        """Whether a mesh is being read."""
        return self._task is not None

    def open(self, path: str | Path, *, recovers: bool = False, wanting: Wanting | None = None) -> None:
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
        self._task.told.connect(self.told)
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

    def shut_down(self) -> None:
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
            if isinstance(result, Wanting):
                self.wanting.emit(result)
                return
            if isinstance(result, State):
                self._document.replace(result, self._path)
            elif isinstance(result, Restored):
                self._path = result.path
                self._document.replace(result.state, result.path)
                self.restored.emit(result)
            else:
                self._task = task  # busy until all have taken it: what they tell meanwhile is no deed of the user's
                self.loaded.emit(result, None if self._recovers else self._path)
                self._task = None
            self.ended.emit(self._document.path if self._recovers and self._document.path else self._path)
