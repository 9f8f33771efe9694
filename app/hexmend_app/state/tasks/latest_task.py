"""Background tasks one at a time; a new request replaces the pending request."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task


class LatestTask(OneTask):
    """Computes a function of one request at a time; of the requests made meanwhile, only the latest is computed next.

    Signals
    -------
    found
        The latest request has ended: `result` or `error` is set.

    Attributes
    ----------
    result : object
        Result of the last request that has ended; None while there is none.
    error : BaseException or None
        Error of that request, if it failed.

    Parameters
    ----------
    name : str
        Name of the computation, for its thread.
    compute : callable
        Called with the arguments of `ask` in a thread.
    """

    found = Signal()

    def __init__(self, name: str, compute: Callable[..., Any], parent: QObject | None = None):
        super().__init__(parent)
        self._name, self._compute = name, compute
        self._latest: tuple[Any, ...] | None = None
        self._active: tuple[Any, ...] | None = None
        self._ended: tuple[Any, ...] | None = None  # the request of `result` and `error`
        self.result: Any = None
        self.error: BaseException | None = None

    @property
    def busy(self) -> bool:
        """True until the latest request has ended."""
        return self._latest is not self._ended

    def of(self, subject: object) -> Any:
        """Return the result if this object is the first argument of the request that led to it; else None."""
        return self.result if self._ended is not None and self._ended[0] is subject else None

    def ask(self, *request: Any) -> None:
        """Request a computation, unless this was the last request."""
        if request != self._latest:
            self._latest = request
            if self._task is None:
                self._begin()

    def forget(self) -> None:
        """Drop the result, and those of pending requests."""
        self._latest = self._ended = self.result = self.error = None

    def close(self) -> None:
        """Cancel the task and drop its result."""
        self._latest = self._ended = None
        super().close()

    def _begin(self) -> None:
        self._active, self.error = self._latest, None
        request, compute = self._active, self._compute
        self._start(self._name, lambda _: compute(*request))

    def _finish(self, task: Task) -> None:
        if self._latest is None:
            return
        if self._active != self._latest:
            self._begin()
            return
        self.result, self.error, self._ended = task.result, task.error, self._latest
        self.found.emit()
