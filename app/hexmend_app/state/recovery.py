"""The way back after an unexpected end: the session is written beside the window, and found again at the next start.

What is new of it is written each time, into a folder that is whole at any moment (`hexmend.io.session.KeptSession`).
Every window has a folder of its own below `state_folder`, with a lock that ends with its process. A window that ends in
order removes its folder; one whose lock nobody holds any more was left by a crash.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from hexmend.errors import HexmendError
from hexmend.io.archive_members import DESCRIPTION
from hexmend.io.atomic import replacing
from hexmend.io.session import KeptSession
from hexmend.io.temporary_files import flush_folder, make_folder
from hexmend_app.state import session_data
from hexmend_app.state.places import state_folder
from hexmend_app.state.task import Task

if TYPE_CHECKING:
    from hexmend_app.state.session import Session

#: Milliseconds between two looks at whether something has changed.
PERIOD = 180_000

_FOLDER, _LOCK, _SESSION, _ABOUT = "windows", "lock", "session.hexmend", "about.json"
#: What a file of an earlier version is called until all that is in it is written anew.
_EARLIER = "earlier.hexmend"
#: Bytes of an account that are read.
_LARGEST = 10_000


@dataclass(frozen=True, eq=False)
class Left:
    """What a window has left that did not end in order.

    Parameters
    ----------
    folder : Path
    lock : QLockFile
        Held, so that no other window offers it.
    name : str
        What its mesh was called.
    runs : int
        How many runs were on it.
    when : datetime
        When it was written, in local time.
    """

    folder: Path
    lock: QLockFile
    name: str
    runs: int
    when: datetime

    @property
    def path(self) -> Path:
        """The session."""
        return self.folder / _SESSION


class Recovery(QObject):
    """Writes the session while the window is open, when something has changed and nothing runs, and after every run.

    Parameters
    ----------
    session : Session

    Signals
    -------
    written
        The session is on disk.
    failed(Exception)
        It could not be written.
    """

    written = Signal()
    failed = Signal(object)

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session = session
        self._folder: Path | None = None
        self._kept: KeptSession | None = None
        self._lock: QLockFile | None = None
        self._task: Task | None = None
        self._after: list[Callable[[], object]] = []  # what is done once the session has been written
        self._changed = False
        self._taken_up: Left | None = None
        self._left: list[Left] = []
        self._timer = QTimer(self, interval=PERIOD)
        self._timer.timeout.connect(self.write)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self.write)
        for told in (session.document.changes_changed, session.timeline.runs_changed, session.view.look_changed,
                     session.kept.changed, session.views.changed, session.order.changed, session.chain.changed,
                     session.comparison.changed, session.cameras.changed):  # fmt: skip
            told.connect(self._on_change)
        for told in (session.smoothing.ended, session.smoothing.failed):
            told.connect(lambda _: self._on_run())
        session.opener.ended.connect(lambda _: self._on_opened())
        session.opener.failed.connect(lambda *_: self._give_up())
        session.opener.cancelled.connect(lambda _: self._give_up())

    @property
    def watching(self) -> bool:
        """Whether the session is written beside the window."""
        return self._lock is not None

    @property
    def left(self) -> tuple[Left, ...]:
        """What windows have left that did not end in order, the newest first."""
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
        self._folder, self._lock, self._kept = folder, _locked(folder), KeptSession(folder / _SESSION)
        others = [one for one in place.iterdir() if one.is_dir() and one != folder]
        self._left = sorted(filter(None, map(_found, others)), key=lambda one: one.when, reverse=True)
        self._changed = True
        self._timer.start()

    def write(self) -> None:
        """Write the session, where there is something to lose and nothing runs."""
        session = self._session
        runs = session.smoothing.busy or session.stepping.sweep is not None or session.opener.busy
        if not (self.watching and self._changed and self._worth) or runs or self._task is not None:
            return
        self._changed = False
        self._task = Task("keeping the session", partial(_write, self._folder, self._kept, session.given()))
        self._task.ended.connect(self._on_written)
        self._task.start()

    def take_up(self, left: Left) -> None:
        """Open what was left; once it is open it is this window's."""
        self._taken_up = left
        self._session.smoothing.end(lambda: self._session.opener.open(left.path, recovers=True))

    def forget(self, left: Left) -> None:
        """Remove what was left."""
        self._left.remove(left)
        _removed(left.folder, left.lock)

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
            remove = partial(_removed, self._folder, self._lock)
            self._lock = None
            task.drop(remove) if task is not None else remove()

    @property
    def _worth(self) -> bool:
        """Whether there is something that its file has not."""
        session = self._session
        work = session.history.records or session.chain.stages or session.comparison.results or session.kept.all
        unsaved = session.document.modified or session.cameras.modified
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

    def _begin_anew(self, left: Left | None) -> None:
        """Remove what was written of another mesh; what was taken up is as good as written."""
        _remove_session(self._folder)
        self._kept = KeptSession(self._folder / _SESSION)
        if left is None:
            return
        for name in (_SESSION, _ABOUT):
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
        elif not after:
            self.written.emit()


def _write(folder: Path, kept: KeptSession, data: session_data.SessionData, task: Task) -> None:
    """Write what is new of a session, with an account of it."""
    name = Path(data.document.path or data.document.now.mesh.name).name
    about = json.dumps({"name": name, "runs": len(data.history.records)})
    with replacing(folder / _ABOUT) as temporary:
        temporary.write_text(about, encoding="utf-8")
    if (folder / _SESSION).is_file():
        os.replace(folder / _SESSION, folder / _EARLIER)
    session_data.keep(kept, data)
    (folder / _EARLIER).unlink(missing_ok=True)


def _locked(folder: Path) -> QLockFile | None:
    """The lock of a window's folder; None where its process holds it."""
    lock = QLockFile(str(folder / _LOCK))
    lock.setStaleLockTime(0)  # however old it is, it is held as long as its process lives
    return lock if lock.tryLock(0) else None


def _found(folder: Path) -> Left | None:
    """What was left in a folder; None where its window is open, and where there is nothing, which is removed."""
    lock = _locked(folder)
    if lock is None:
        return None
    try:
        session = folder / _SESSION
        if (folder / _EARLIER).is_file() and not (session / DESCRIPTION).exists():  # it was being written anew
            shutil.rmtree(session, ignore_errors=True)
            os.replace(folder / _EARLIER, session)
        written = session if session.is_file() else session / DESCRIPTION  # a file is of an earlier version
        when = datetime.fromtimestamp(written.stat().st_mtime)
    except OSError:
        _removed(folder, lock)
        return None
    name, runs = "", 0
    with suppress(OSError, ValueError, AttributeError, TypeError):
        with open(folder / _ABOUT, encoding="utf-8") as file:
            about = json.loads(file.read(_LARGEST))
        name, runs = str(about.get("name", "")), int(about.get("runs", 0))
    return Left(folder, lock, name, runs, when)


def _removed(folder: Path, lock: QLockFile) -> None:
    """Remove a window's folder, what is in it first: as long as it is locked, nobody offers it."""
    _remove_session(folder)
    lock.unlock()
    shutil.rmtree(folder, ignore_errors=True)


def _remove_session(folder: Path) -> None:
    """Remove what a window's folder holds of a session; first what would take its place, and what makes it one."""
    for path in (folder / _EARLIER, folder / _SESSION / DESCRIPTION, folder / _SESSION, folder / _ABOUT):
        with suppress(OSError):
            path.unlink()
    shutil.rmtree(folder / _SESSION, ignore_errors=True)
