"""Autosave: writes the session in the background, and finds it again at the next start after a crash.

Each time, only new data are written, into a folder that is valid at any moment (`SessionFolder`).
Every window has its own folder below `state_folder`, with a lock that ends with its process. A window that closes
normally removes its folder; a folder that is not locked was left by a crash.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from hexmend.errors import HexmendError
from hexmend.io.storage.temporary_files import flush_folder, make_folder
from hexmend_app.formats.session.session_file import SessionFolder
from hexmend_app.state.session.recovery_folder import (
    ABOUT,
    SESSION,
    RecoveredSession,
    find_session,
    lock_folder,
    remove_folder,
    remove_session,
    write_session,
)
from hexmend_app.state.session.running import ended_now
from hexmend_app.state.settings.paths import state_folder
from hexmend_app.state.tasks.task import Task

if TYPE_CHECKING:
    from hexmend_app.state.run.worker import IterationFrame
    from hexmend_app.state.session.session import Session

#: Milliseconds between two checks for changes.
PERIOD = 180_000
#: Milliseconds between two of them during a run.
RUN_PERIOD = 10_000

_FOLDER = "windows"


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
        self._session_folder: SessionFolder | None = None
        self._lock: QLockFile | None = None
        self._task: Task | None = None
        self._after_writing: list[Callable[[], object]] = []
        self._changed = False
        self._write_again = False  # the session has changed while it was being written
        self._recovering: RecoveredSession | None = None
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
            signal.connect(lambda _: self._on_run())
        session.opener.began.connect(self._on_began)
        session.opener.ended.connect(lambda _: self._on_opened())
        session.opener.failed.connect(lambda *_: self._cancel_recovering())
        session.opener.cancelled.connect(lambda _: self._cancel_recovering())

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
        windows = state_folder() / _FOLDER
        folder = windows / f"{os.getpid()}-{os.urandom(4).hex()}"
        try:
            make_folder(windows)
            folder.mkdir(mode=0o700)
            flush_folder(windows)
        except OSError as error:
            self.failed.emit(error)
            return
        self._folder, self._lock, self._session_folder = folder, lock_folder(folder), SessionFolder(folder / SESSION)
        found = map(find_session, [path for path in windows.iterdir() if path.is_dir() and path != folder])
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
        if not (self.watching and self._changed and self._has_unsaved_data) or active:
            return
        if self._task is not None:
            self._write_again = True
            return
        self._changed, self._newest = False, newest
        data = session.to_data()
        if newest is not None:
            data = ended_now(data, session.run.record, newest)
        write = partial(write_session, self._folder, self._session_folder, data)
        self._task = Task("autosaving the session", write)
        self._task.ended.connect(self._on_written)
        self._task.start()

    def recover(self, crashed: RecoveredSession) -> None:
        """Open the session of a crashed window; once open, it is autosaved by this window."""
        self._recovering = crashed
        self._session.run.end(lambda: self._session.opener.open(crashed.path, recovers=True))

    def discard(self, crashed: RecoveredSession) -> None:
        """Delete the session of a crashed window."""
        self._recoverable.remove(crashed)
        remove_folder(crashed.folder, crashed.lock)

    def end(self) -> None:
        """End the autosave and delete its folder: the window closes normally."""
        self._timer.stop()
        self._run_timer.stop()
        self._soon.stop()
        self._after_writing.clear()
        for crashed in self._recoverable:
            crashed.lock.unlock()  # for the next start
        self._recoverable.clear()
        task, self._task = self._task, None
        if self._lock is not None:
            remove = partial(remove_folder, self._folder, self._lock)
            self._lock = None
            task.drop(remove) if task is not None else remove()

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

    def _on_run(self) -> None:
        self._changed = True
        self._soon.start()

    def _on_opened(self) -> None:
        """Restart the autosave for the mesh that was opened, as soon as nothing is being written."""
        if not self.watching:
            return
        recovered, self._recovering = self._recovering, None
        if self._task is not None:
            self._after_writing.append(partial(self._restart, recovered))
        else:
            self._restart(recovered)

    def _restart(self, recovered: RecoveredSession | None) -> None:
        """Delete the autosave of the mesh before; the files of a recovered session become those of this window."""
        remove_session(self._folder)
        self._session_folder = SessionFolder(self._folder / SESSION)
        if recovered is None:
            return
        for name in (SESSION, ABOUT):
            with suppress(OSError):
                os.replace(recovered.folder / name, self._folder / name)
        flush_folder(self._folder)
        self.discard(recovered)

    def _cancel_recovering(self) -> None:
        self._recovering = None

    def _on_began(self, path: Path) -> None:
        """Another file is read instead of the recovered session."""
        if self._recovering is not None and path != self._recovering.path:
            self._recovering = None

    def _on_written(self) -> None:
        task, self._task = self._task, None
        callbacks, self._after_writing = self._after_writing, []
        for callback in callbacks:
            callback()
        if isinstance(task.error, HexmendError | OSError):
            self._changed = True  # the next attempt may succeed
            self.failed.emit(task.error)
        elif task.error is not None:
            raise task.error
        else:
            again, self._write_again = self._write_again, False
            if again:
                self.write()
            if self._task is None and not callbacks:
                self.written.emit()
