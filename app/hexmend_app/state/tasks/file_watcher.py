"""Progress of the files that a background task reads or writes."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

from hexmend.errors import HexmendError
from hexmend.io.storage.file_progress import FileProgress
from hexmend_app.state.tasks.task import Task

#: Seconds between reports.
INTERVAL = 0.2


class FileWatcher:
    """Listener for `hexmend.io.storage.file_progress.watch_files` that lets a task report, a few times a second.

    Parameters
    ----------
    task : Task
    message : callable
        Makes the message that is reported from a `FileProgress`.
    ends : bool
        Raise a `HexmendError` once the task is cancelled, which ends the reading.
    """

    def __init__(self, task: Task, message: Callable[[FileProgress], Any], *, ends: bool):
        self._task, self._message, self._ends = task, message, ends
        self._due = monotonic() + INTERVAL

    def __call__(self, progress: FileProgress) -> None:
        """Report the progress if it is time, and end the reading if that is cancelled."""
        if progress.ended:
            return
        if self._ends and self._task.cancelled.is_set():
            raise HexmendError(f"{progress.action.value} {progress.path.name} was cancelled.")
        if monotonic() >= self._due:
            self._due = monotonic() + INTERVAL
            self._task.report(self._message(progress))
