"""Autosave folder of a window: the files of its session, and a lock that ends with the window's process."""

from __future__ import annotations

import json
import shutil
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QLockFile

from hexmend.io.storage.atomic import atomic_write
from hexmend_app.formats.session.members import DESCRIPTION
from hexmend_app.formats.session.session_file import SessionFolder
from hexmend_app.state.session import session_data
from hexmend_app.state.tasks.task import Task

_LOCK, SESSION, ABOUT = "lock", "session.hexmend", "about.json"
#: Bytes that are read of a description.
_MAX_ABOUT_BYTES = 10_000


@dataclass(frozen=True, eq=False)
class RecoveredSession:
    """Session of a window that crashed.

    Parameters
    ----------
    folder : Path
    lock : QLockFile
        Locked, so that no other window offers the session.
    name : str
        Name of the mesh.
    runs : int
        Number of runs.
    when : datetime
        Local time at which the session was written.
    """

    folder: Path
    lock: QLockFile
    name: str
    runs: int
    when: datetime

    @property
    def path(self) -> Path:
        """Path of the session."""
        return self.folder / SESSION


def write_session(folder: Path, session_folder: SessionFolder, data: session_data.SessionData, task: Task) -> None:
    """Write the new data of a session, with a description of it."""
    name = Path(data.document.path or data.document.now.mesh.name).name
    about = json.dumps({"name": name, "runs": len(data.history.records)})
    with atomic_write(folder / ABOUT) as temporary:
        temporary.write_text(about, encoding="utf-8")
    session_data.write_new(session_folder, data)


def lock_folder(folder: Path) -> QLockFile | None:
    """Lock a window's folder; None if another process has locked it."""
    lock = QLockFile(str(folder / _LOCK))
    lock.setStaleLockTime(0)  # a lock of any age is valid as long as its process lives
    return lock if lock.tryLock(0) else None


def find_session(folder: Path) -> RecoveredSession | None:
    """Return the session in a folder; None if its window is open. A folder without a session is removed."""
    lock = lock_folder(folder)
    if lock is None:
        return None
    try:
        when = datetime.fromtimestamp((folder / SESSION / DESCRIPTION).stat().st_mtime)
    except OSError:
        remove_folder(folder, lock)
        return None
    name, runs = "", 0
    with suppress(OSError, ValueError, AttributeError, TypeError):
        with open(folder / ABOUT, encoding="utf-8") as file:
            about = json.loads(file.read(_MAX_ABOUT_BYTES))
        name, runs = str(about.get("name", "")), int(about.get("runs", 0))
    return RecoveredSession(folder, lock, name, runs, when)


def remove_folder(folder: Path, lock: QLockFile) -> None:
    """Remove a window's folder; it is unlocked only when its session is deleted, so that no window offers it."""
    remove_session(folder)
    lock.unlock()
    shutil.rmtree(folder, ignore_errors=True)


def remove_session(folder: Path) -> None:
    """Delete the session in a window's folder; its description first, so that no partly deleted session is found."""
    for path in (folder / SESSION / DESCRIPTION, folder / ABOUT):
        with suppress(OSError):
            path.unlink()
    shutil.rmtree(folder / SESSION, ignore_errors=True)
