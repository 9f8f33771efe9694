"""The way back after an unexpected end: the session is written beside the window, and found again at the next start.

What is new of it is written each time, into a folder that is whole at any moment (`SessionFolder`).
Every window has a folder of its own below `state_folder`, with a lock that ends with its process. A window that ends in
order removes its folder; one whose lock nobody holds any more was left by a crash.
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
from hexmend.io.formats.session.session_file import SessionFolder
from hexmend.io.storage.temporary_files import flush_folder, make_folder
from hexmend_app.state.session.recovery_folder import (
    ABOUT,
    SESSION,
    RecoveredSession,
    found,
    locked,
    remove_folder,
    remove_session,
    write_session,
)
from hexmend_app.state.settings.paths import state_folder
from hexmend_app.state.tasks.task import Task

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session

#: Milliseconds between two looks at whether something has changed.
PERIOD = 180_000

_FOLDER = "windows"


class Recovery(QObject):
    """Writes the session while the window is open, when something has changed and nothing runs, and after every run.

    Parameters
    ----------
    session : Session

    Signals
    -------
    written
        The session is on disk, as it was when `write` was called last.
    failed(Exception)
        It could not be written.
    """

    written = Signal()
    failed = Signal(object)

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session = session
        self._folder: Path | None = None
        self._kept: SessionFolder | None = None
        self._lock: QLockFile | None = None
        self._task: Task | None = None
        self._after: list[Callable[[], object]] = []  # what is done once the session has been written
        self._changed = False
        self._again = False  # whether a change is to be written as soon as what is being written is on disk
        self._taken_up: RecoveredSession | None = None
        self._left: list[RecoveredSession] = []
        self._timer = QTimer(self, interval=PERIOD)
        self._timer.timeout.connect(self.write)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self.write)
        session.data_changed.connect(self._on_change)
        for signal in (session.run.ended, session.run.failed):
            signal.connect(lambda _: self._on_run())
        session.opener.ended.connect(lambda _: self._on_opened())
        session.opener.failed.connect(lambda *_: self._give_up())
        session.opener.cancelled.connect(lambda _: self._give_up())

    @property
    def watching(self) -> bool:
        """True while the session is saved automatically."""
        return self._lock is not None

    @property
    def left(self) -> tuple[RecoveredSession, ...]:
        """Sessions of windows that did not end in order, the newest first."""
        return tuple(self._left)

    def begin(self) -> None:
        """Look for what was left, and write the session from now on; where there is no place for it, say why."""
        if self.watching:
            return
        place = state_folder() / _FOLDER
        folder = place / f"{os.getpid()}-{os.urandom(4).hex()}"
        try:
            make_folder(place)
            folder.mkdir(mode=0o700)
            flush_folder(place)
        except OSError as error:
            self.failed.emit(error)
            return
        self._folder, self._lock, self._kept = folder, locked(folder), SessionFolder(folder / SESSION)
        others = [one for one in place.iterdir() if one.is_dir() and one != folder]
        self._left = sorted(filter(None, map(found, others)), key=lambda one: one.when, reverse=True)
        self._changed = True
        self._timer.start()

    def write(self) -> None:
        """Write the session, where there is something to lose and nothing runs; once more if it is being written."""
        session = self._session
        runs = session.run.busy or session.node_sweep.sweep is not None or session.opener.busy
        if not (self.watching and self._changed and self._worth) or runs:
            return
        if self._task is not None:
            self._again = True
            return
        self._changed = False
        self._task = Task("keeping the session", partial(write_session, self._folder, self._kept, session.to_data()))
        self._task.ended.connect(self._on_written)
        self._task.start()

    def take_up(self, left: RecoveredSession) -> None:
        """Open what was left; once it is open it is this window's."""
        self._taken_up = left
        self._session.run.end(lambda: self._session.opener.open(left.path, recovers=True))

    def forget(self, left: RecoveredSession) -> None:
        """Remove what was left."""
        self._left.remove(left)
        remove_folder(left.folder, left.lock)

    def end(self) -> None:
        """The window ends in order: nothing is left of it."""
        self._timer.stop()
        self._soon.stop()
        self._after.clear()
        for left in self._left:
            left.lock.unlock()  # for the next start
        self._left.clear()
        task, self._task = self._task, None
        if self._lock is not None:
            remove = partial(remove_folder, self._folder, self._lock)
            self._lock = None
            task.drop(remove) if task is not None else remove()

    @property
    def _worth(self) -> bool:
        """Return True if there is anything that the file does not contain."""
        session = self._session
        work = (
            session.history.records
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
        """Begin anew with the mesh that was opened, once what is being written of another is on disk."""
        if not self.watching:
            return
        left, self._taken_up = self._taken_up, None
        if self._task is not None:
            self._after.append(partial(self._begin_anew, left))
        else:
            self._begin_anew(left)

    def _begin_anew(self, left: RecoveredSession | None) -> None:
        """Remove what was written of another mesh; what was taken up is as good as written."""
        remove_session(self._folder)
        self._kept = SessionFolder(self._folder / SESSION)
        if left is None:
            return
        for name in (SESSION, ABOUT):
            with suppress(OSError):
                os.replace(left.folder / name, self._folder / name)
        flush_folder(self._folder)
        self.forget(left)

    def _give_up(self) -> None:
        self._taken_up = None

    def _on_written(self) -> None:
        task, self._task = self._task, None
        after, self._after = self._after, []
        for act in after:
            act()
        if isinstance(task.error, HexmendError | OSError):
            self.failed.emit(task.error)
        elif task.error is not None:
            raise task.error
        else:
            again, self._again = self._again, False
            if again:
                self.write()
            if self._task is None and not after:
                self.written.emit()
