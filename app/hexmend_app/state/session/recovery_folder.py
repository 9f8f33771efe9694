"""A window's folder of recovery: what it holds of a session, and the lock that ends with the window's process."""

from __future__ import annotations

import json
import os
import shutil
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QLockFile

from hexmend.io.archive.members import DESCRIPTION
from hexmend.io.formats.session.session_file import SessionFolder
from hexmend.io.storage.atomic import atomic_write
from hexmend_app.state.session import session_data
from hexmend_app.state.tasks.task import Task

_LOCK, SESSION, ABOUT = "lock", "session.hexmend", "about.json"
#: What a file of an earlier version is called until all that is in it is written anew.
EARLIER = "earlier.hexmend"
#: Bytes of an account that are read.
_LARGEST = 10_000


@dataclass(frozen=True, eq=False)
class RecoveredSession:
    """Session of a window that did not end in order.

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
        return self.folder / SESSION


def write_session(folder: Path, kept: SessionFolder, data: session_data.SessionData, task: Task) -> None:
    """Write what is new of a session, with an account of it."""
    name = Path(data.document.path or data.document.now.mesh.name).name
    about = json.dumps({"name": name, "runs": len(data.history.records)})
    with atomic_write(folder / ABOUT) as temporary:
        temporary.write_text(about, encoding="utf-8")
    if (folder / SESSION).is_file():
        os.replace(folder / SESSION, folder / EARLIER)
    session_data.keep(kept, data)
    (folder / EARLIER).unlink(missing_ok=True)


def locked(folder: Path) -> QLockFile | None:
    """The lock of a window's folder; None where its process holds it."""
    lock = QLockFile(str(folder / _LOCK))
    lock.setStaleLockTime(0)  # however old it is, it is held as long as its process lives
    return lock if lock.tryLock(0) else None


def found(folder: Path) -> RecoveredSession | None:
    """Find the session in a folder; None if its window is open, or if there is none, in which case it is removed."""
    lock = locked(folder)
    if lock is None:
        return None
    try:
        session = folder / SESSION
        if (folder / EARLIER).is_file() and not (session / DESCRIPTION).exists():  # it was being written anew
            shutil.rmtree(session, ignore_errors=True)
            os.replace(folder / EARLIER, session)
        written = session if session.is_file() else session / DESCRIPTION  # a file is of an earlier version
        when = datetime.fromtimestamp(written.stat().st_mtime)
    except OSError:
        remove_folder(folder, lock)
        return None
    name, runs = "", 0
    with suppress(OSError, ValueError, AttributeError, TypeError):
        with open(folder / ABOUT, encoding="utf-8") as file:
            about = json.loads(file.read(_LARGEST))
        name, runs = str(about.get("name", "")), int(about.get("runs", 0))
    return RecoveredSession(folder, lock, name, runs, when)


def remove_folder(folder: Path, lock: QLockFile) -> None:
    """Remove a window's folder, what is in it first: as long as it is locked, nobody offers it."""
    remove_session(folder)
    lock.unlock()
    shutil.rmtree(folder, ignore_errors=True)


def remove_session(folder: Path) -> None:
    """Remove what a window's folder holds of a session; first what would take its place, and what makes it one."""
    for path in (folder / EARLIER, folder / SESSION / DESCRIPTION, folder / SESSION, folder / ABOUT):
        with suppress(OSError):
            path.unlink()
    shutil.rmtree(folder / SESSION, ignore_errors=True)
