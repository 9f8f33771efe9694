"""Autosave: writes the session in the background, and finds it again at the next start after a crash.

Every window has its own folder below `state_folder`, with a session file and a lock that ends with its process. A
window that closes normally removes its folder; a folder that is not locked was left by a crash.
"""

from __future__ import annotations

import os
import shutil
import sys
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from hexmend.errors import HexmendError
from hexmend.io.storage.temporary_files import make_folder
from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.mesh.document import Change
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.run.worker import IterationFrame
from hexmend_app.state.session import session_data
from hexmend_app.state.tasks.task import Task
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session

#: Milliseconds between two checks for changes.
PERIOD = 180_000
#: Milliseconds between two of them during a run.
RUN_PERIOD = 60_000
#: Environment variable that overrides the folder.
VARIABLE = "HEXMEND_STATE"


@dataclass(frozen=True, eq=False)
class RecoveredSession:
    """Session of a window that crashed.

    Parameters
    ----------
    path : Path
        Session file, alone in its folder with the lock.
    lock : QLockFile
        Locked, so that no other window offers the session.
    when : datetime
        Local time at which the session was written.
    """

    path: Path
    lock: QLockFile
    when: datetime

    @property
    def name(self) -> str:
        """Name of the mesh."""
        return self.path.name.removesuffix(SUFFIX)


class Recovery(QObject):
    """Saves the session automatically: periodically if it has changed, during a run and after it.

    Parameters
    ----------
    session : Session

    Signals
    -------
    written
        The session is on disk as it was at the last call of `write`.
    failed(Exception)
        The session could not be written.
    """

    written = Signal()
    failed = Signal(object)

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session = session
        self._folder: Path | None = None
        self._lock: QLockFile | None = None
        self._task: Task | None = None
        self._changed = False
        self._outdated = False  # what is being written is of a mesh that is no longer open
        self._recovering: RecoveredSession | None = None  # is being opened, or not yet written by this window
        self._recoverable: list[RecoveredSession] = []
        self._timer = QTimer(self, interval=PERIOD)
        self._timer.timeout.connect(self.write)
        self._newest: IterationFrame | None = None  # of a run, as last written
        self._run_timer = QTimer(self)
        self._run_timer.timeout.connect(self._write_run)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self.write)
        session.data_changed.connect(self._on_change)
        for signal in (session.run.ended, session.run.failed):
            signal.connect(self._on_run)
        session.opener.began.connect(self._on_began)
        session.opener.ended.connect(self._on_opened)

    @property
    def watching(self) -> bool:
        """True while the session is saved automatically."""
        return self._lock is not None

    @property
    def recoverable(self) -> tuple[RecoveredSession, ...]:
        """Sessions of windows that crashed, newest first."""
        return tuple(self._recoverable)

    def begin(self) -> None:
        """Find sessions left by crashes, and start the autosave; emit `failed` if its folder cannot be made."""
        if self.watching:
            return
        windows = state_folder() / "windows"
        folder = windows / f"{os.getpid()}-{os.urandom(4).hex()}"
        try:
            make_folder(windows)
            folder.mkdir(mode=0o700)
        except OSError as error:
            self.failed.emit(error)
            return
        self._folder, self._lock = folder, _lock_folder(folder)
        found = map(_find_session, [path for path in windows.iterdir() if path.is_dir() and path != folder])
        self._recoverable = sorted(filter(None, found), key=lambda session: session.when, reverse=True)
        self._changed = True
        self._timer.start()
        self._run_timer.start(RUN_PERIOD)

    def write(self) -> None:
        """Write the session if it has unsaved data and no run is active; if it is being written, write it again."""
        if not self._session.run.busy:
            self._write(None)

    def _write_run(self) -> None:
        """Write the session with the newest iteration of the active run, unless it is being written."""
        newest = self._session.run.newest
        if newest is not None and newest.iteration.number and newest is not self._newest and self._task is None:
            self._changed = True
            self._write(newest)

    def _write(self, newest: IterationFrame | None) -> None:
        """Write the session, with the newest iteration of the active run if that is not None."""
        session = self._session
        active = session.node_sweep.sweep is not None or session.opener.busy or session.time_reader.busy
        if not (self.watching and self._changed and self._has_unsaved_data) or active or self._task is not None:
            return
        self._changed, self._newest = False, newest
        data = session.to_data()
        if newest is not None:
            data = _ended_now(data, session.run.record, newest)
        path = self._folder / f"{session.document.name or 'mesh'}{SUFFIX}"
        self._task = Task("autosaving the session", lambda _: session_data.write(path, data))
        self._task.ended.connect(self._on_written)
        self._task.start()

    def recover(self, crashed: RecoveredSession) -> None:
        """Open the session of a crashed window; once open, it is autosaved by this window."""
        self._session.run.finish_then(lambda: self._session.opener.open(crashed.path, recovers=True))
        self._recovering = crashed

    def discard(self, crashed: RecoveredSession) -> None:
        """Delete the session of a crashed window."""
        self._recoverable.remove(crashed)
        _remove_folder(crashed.path.parent, crashed.lock)

    def end(self) -> None:
        """End the autosave and delete its folder: the window closes normally."""
        for timer in (self._timer, self._run_timer, self._soon):
            timer.stop()
        for crashed in self._recoverable:
            crashed.lock.unlock()  # for the next start
        self._recoverable.clear()
        task, folder, lock = self._task, self._folder, self._lock
        self._task = self._lock = None
        if task is not None:
            task.drop(lambda: _remove_folder(folder, lock))
        elif lock is not None:
            _remove_folder(folder, lock)

    @property
    def _has_unsaved_data(self) -> bool:
        """True if the session contains anything that the file of its mesh does not."""
        session = self._session
        work = (
            any(not record.holds_times for record in session.history.records)
            or session.recipe_draft.stages
            or session.comparison.results
            or session.snapshots.all
        )
        unsaved = session.document.modified or session.saved_cameras.modified
        return session.document.is_open and bool(unsaved or work)

    def _on_change(self, *_: object) -> None:
        self._changed = True

    def _on_run(self, *_: object) -> None:
        self._changed = True
        self._soon.start()

    def _on_began(self, path: Path) -> None:
        """Another file is read instead of the recovered session."""
        if self._recovering is not None and path != self._recovering.path:
            self._recovering = None

    def _on_opened(self, *_: object) -> None:
        """Delete the autosave of the mesh before; write a recovered session at once."""
        self._changed = True
        if self._task is not None:
            self._outdated = True
        elif self.watching:
            _remove_sessions(self._folder)
            if self._recovering is not None:
                self._soon.start()

    def _on_written(self) -> None:
        task, self._task = self._task, None
        outdated, self._outdated = self._outdated, False
        if isinstance(task.error, HexmendError | OSError):
            self._changed = True  # the next attempt may succeed
            self.failed.emit(task.error)
        elif task.error is not None:
            raise task.error
        elif outdated:
            self._on_opened()
            self.write()
        else:
            if self._recovering in self._recoverable:
                self.discard(self._recovering)
            self._recovering = None
            self.write()
            if self._task is None:
                self.written.emit()


def _ended_now(data: session_data.SessionData, record: RunRecord, newest: IterationFrame) -> session_data.SessionData:
    """Return the data of a session, made after `newest` was recorded, as if the active run had ended with it.

    Positions of earlier iterations of this run are left out, so that little is written.
    """
    at = next(k for k, one in enumerate(data.history.records) if one.name == record.name)
    number, state, message = newest.iteration.number, newest.state, tr("cut short")
    ended = replace(data.history.records[at], result=number, end=state, message=message, offsets=())
    records = (*data.history.records[:at], ended, *data.history.records[at + 1 :])
    iterations = (*(one for one in data.history.iterations if one[0] is not state), (state, at, number))
    before = data.document.changes[: data.document.at + 1]
    document = replace(data.document, changes=(*before, Change(record.title, state)), at=len(before), now=state)
    return replace(data, document=document, history=replace(data.history, records=records, iterations=iterations))


def _lock_folder(folder: Path) -> QLockFile | None:
    """Lock a window's folder; None if another process has locked it."""
    lock = QLockFile(str(folder / "lock"))
    lock.setStaleLockTime(0)  # a lock of any age is valid as long as its process lives
    return lock if lock.tryLock(0) else None


def _find_session(folder: Path) -> RecoveredSession | None:
    """Return the session in a folder; None if its window is open. A folder without a session is removed."""
    lock = _lock_folder(folder)
    if lock is None:
        return None
    try:
        path = max(folder.glob(f"*{SUFFIX}"), key=lambda path: path.stat().st_mtime)
        return RecoveredSession(path, lock, datetime.fromtimestamp(path.stat().st_mtime))
    except (OSError, ValueError):  # there is none
        _remove_folder(folder, lock)
        return None


def _remove_folder(folder: Path, lock: QLockFile) -> None:
    """Remove a window's folder; it is unlocked only when its session is deleted, so that no window offers it."""
    _remove_sessions(folder)
    lock.unlock()
    shutil.rmtree(folder, ignore_errors=True)


def _remove_sessions(folder: Path) -> None:
    for path in folder.glob(f"*{SUFFIX}"):
        with suppress(OSError):
            path.unlink()


def state_folder() -> Path:
    """Return the state folder of the user by the convention of the system; it may not exist yet."""
    if override := os.environ.get(VARIABLE):
        return Path(override).absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "Hexmend"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Hexmend"
    base = Path(os.environ.get("XDG_STATE_HOME") or "")
    return (base if base.is_absolute() else Path.home() / ".local" / "state") / "hexmend"  # relative paths are ignored
