"""Base class of objects that have one task at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject

from hexmend_app.state.tasks.task import Task


class OneTask(QObject):
    """Object with at most one task in the background, whose reports and end it takes."""

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._task: Task | None = None

    @property
    def busy(self) -> bool:
        """True while the task runs."""
        return self._task is not None

    def close(self) -> None:
        """Drop the task and its result, without a signal."""
        task, self._task = self._task, None
        if task is not None:
            task.drop()

    def _start(self, name: str, work: Callable[[Task], Any], yields: bool = False) -> None:
        """Start a task; see `Task`."""
        self._task = Task(name, work, yields)
        self._task.reported.connect(self._take)
        self._task.ended.connect(self._end)
        self._task.start()

    def _end(self) -> None:
        task, self._task = self._task, None
        self._finish(task)

    def _take(self, message: Any) -> None:
        """Take a message that the task has reported."""

    def _finish(self, task: Task) -> None:
        """Take the result or the error of the task, which has ended."""
        raise NotImplementedError
