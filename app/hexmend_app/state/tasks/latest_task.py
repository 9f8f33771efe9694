"""Background tasks of which only the latest request counts."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QObject

from hexmend_app.state.tasks.task import Task, drop


class LatestTask(QObject):
    """Computes one request at a time; of the requests made meanwhile, only the latest is computed next.

    Subclasses make the task of a request and receive its result.
    """

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._latest: tuple[Any, ...] | None = None
        self._active: tuple[Any, ...] | None = None
        self._task: Task | None = None

    def _make_task(self, request: tuple[Any, ...]) -> Task:
        """Return the task that computes a request, not started yet."""
        raise NotImplementedError

    def _on_result(self, task: Task) -> None:
        """Receive the ended task of the latest request."""
        raise NotImplementedError

    def _submit(self, request: tuple[Any, ...]) -> None:
        self._latest = request
        if self._task is None:
            self._start()

    def close(self) -> None:
        """Cancel the task and drop its result."""
        self._latest = None
        drop(self._task)
        self._task = None

    def _start(self) -> None:
        self._active = self._latest
        self._task = self._make_task(self._active)
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if self._latest is None:
            return
        if self._active != self._latest:
            self._start()
        else:
            self._on_result(task)
