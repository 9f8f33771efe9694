"""Questions that are worked out beside the window, and of which only the newest is of interest."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QObject

from hexmend_app.state.tasks.task import Task, drop


class LatestTask(QObject):
    """Works out one question at a time; those that are asked meanwhile wait, and all but the newest are forgotten.

    Its kinds say how a question is worked out and what becomes of the answer.
    """

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._wanted: tuple[Any, ...] | None = None
        self._asked: tuple[Any, ...] | None = None
        self._task: Task | None = None

    def _work(self, question: tuple[Any, ...]) -> Task:
        """Make the task that answers a question, not started yet."""
        raise NotImplementedError

    def _take(self, task: Task) -> None:
        """Take what came of the question that is wanted."""
        raise NotImplementedError

    def _want(self, question: tuple[Any, ...]) -> None:
        self._wanted = question
        if self._task is None:
            self._begin()

    def close(self) -> None:
        """Ask the thread to end; nothing is answered any more."""
        self._wanted = None
        drop(self._task)
        self._task = None

    def _begin(self) -> None:
        self._asked = self._wanted
        self._task = self._work(self._asked)
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        if self._wanted is None:
            return
        if self._asked != self._wanted:
            self._begin()
        else:
            self._take(task)
