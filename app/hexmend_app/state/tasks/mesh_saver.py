"""Saving the mesh, or the session, in a thread while the window stays alive."""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from hexmend.io import unsupported_data, write
from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.session.user_events import MeshSaved
from hexmend_app.state.tasks.task import Task, drop

if TYPE_CHECKING:
    from hexmend_app.state.session.session_parts import SessionParts


class SaveTask:
    """One file that is written: the mesh, or all of the session, as they were when that was asked for.

    Parameters
    ----------
    path : Path
    state : State
        The mesh as it was shown; it is what a mesh file gets.
    recorded : State
        What counts as saved afterwards.
    data : SessionData or None
        What a session's file gets; None for a mesh file.

    Attributes
    ----------
    omitted : list of str
        What the file's format cannot hold, once it is written.
    over : bool
        Whether it has been written, or has failed.
    error : BaseException or None
        Why it has failed.
    """

    def __init__(self, path: Path, state: State, recorded: State, data: SessionData | None):
        self.path, self.state, self.recorded, self.data = path, state, recorded, data
        self.omitted: list[str] = []
        self.over = False
        self.error: BaseException | None = None

    def write(self) -> None:
        """Write the file; raises `HexmendError` where that cannot be done, and what was there stays."""
        if self.data is not None:
            session_data.write(self.path, self.data)
        else:
            write(self.path, self.state.mesh)
            self.omitted = unsupported_data(self.path, self.state.mesh)


class MeshSaver(QObject):
    """Writes meshes and sessions, one after another in the order in which they were asked for.

    Parameters
    ----------
    session : SessionParts

    Signals
    -------
    began(Saving)
        Its file is being written.
    ended(Saving)
        It is on disk, and the document knows.
    failed(Saving)
        It is not, see its `error`; the document is as modified as it was.
    """

    began = Signal(object)
    ended = Signal(object)
    failed = Signal(object)

    def __init__(self, session: SessionParts):
        super().__init__(session)
        self._session = session
        self._waiting: deque[SaveTask] = deque()
        self._saving: SaveTask | None = None
        self._task: Task | None = None

    @property
    def busy(self) -> bool:
        """True while a file is being written."""
        return self._saving is not None

    @property
    def path(self) -> Path | None:
        """The file that is being written; None where there is none."""
        return self._saving and self._saving.path

    def save(self, path: str | Path) -> SaveTask:
        """Begin to write the mesh as it is now, or, under a session's suffix, the session."""
        saving = self._asked(Path(path))
        self._waiting.append(saving)
        self._begin()
        return saving

    def close(self) -> None:
        """Write nothing more; who closes has waited for what is being written, or has chosen not to."""
        self._waiting.clear()
        drop(self._task)
        self._saving = self._task = None

    def _asked(self, path: Path) -> SaveTask:
        """Return what is to be written, with nothing in progress."""
        session, document = self._session, self._session.document
        session.node_sweep.leave()
        if path.suffix.lower() == SUFFIX:
            return SaveTask(path, document.now, document.recorded, session.to_data())
        moment = session.timeline.moment
        if document.previews and session.editable:
            document.commit("go back" if moment is None else f"go to {moment.name}", document.now)
        return SaveTask(path, document.now, document.now, None)

    def _begin(self) -> None:
        if self._saving is None and self._waiting:
            self._saving = saving = self._waiting.popleft()
            self._task = Task(f"saving {saving.path.name}", lambda _: saving.write())
            self._task.ended.connect(self._finish)
            self.began.emit(saving)
            self._task.start()

    def _finish(self) -> None:
        saving, task, self._saving, self._task = self._saving, self._task, None, None
        saving.error = task.error
        if saving.error is None:
            self._take(saving)
        saving.over = True
        (self.ended if saving.error is None else self.failed).emit(saving)
        self._begin()

    def _take(self, saving: SaveTask) -> None:
        """Tell that a file was written, and know that what is in it is saved, if its mesh is open still."""
        session = self._session
        session.user_event.emit(MeshSaved(saving.path, saving.state, saving.data))
        is_open = session.document.saved(saving.path, saving.recorded)
        if is_open and saving.data is not None:
            session.saved_cameras.saved(saving.data.cameras)
