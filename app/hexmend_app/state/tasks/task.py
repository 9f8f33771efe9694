"""Background task: a function in a named thread, which can be cancelled and reports its end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

#: Started tasks that have not been joined. The set keeps them alive, so that no task is deleted in its own thread.
_STARTED: set[Task] = set()


#: Seconds to wait for the threads of dropped tasks when the window closes.
GRACE = 2.0


def running() -> tuple[Task, ...]:
    """Return the tasks whose threads have not ended, sorted by name."""
    return tuple(sorted((task for task in _STARTED if not task.over), key=lambda task: task.name))


def wait_for_dropped() -> None:
    """Wait for the threads of all dropped tasks, at most `GRACE` seconds in total.

    A thread cannot be ended from outside: if it hangs, such as on a network drive, it stays in `running`, and the
    program has to exit its process.
    """
    deadline = time.monotonic() + GRACE
    for task in [task for task in _STARTED if task.dropped]:
        task.join(max(0.0, deadline - time.monotonic()))
        task.call_after_drop()


class Task(QObject):
    """Runs a function in a thread of its own.

    The task belongs to the thread that makes it, in which its signals are emitted.

    Parameters
    ----------
    name : str
        Name of the thread, as `threading.enumerate` and debuggers show it.
    work : callable
        Function that is called in the thread with this task. It should return soon after `cancelled` is set, as it
        cannot be ended from outside.
    yields : bool
        True to give the thread a lower priority than the window, for work that takes seconds.

    Attributes
    ----------
    name : str
    cancelled : threading.Event
    result
        Return value of the work; None until it has ended.
    error : BaseException or None
        Exception that the work raised.

    Signals
    -------
    reported(object)
        A message of the work, see `report`.
    ended
        The work has ended. Always emitted last, unless the task was dropped or waited for.
    """

    reported = Signal(object)
    ended = Signal()
    _message_posted = Signal(object)
    _end_posted = Signal()

    def __init__(self, name: str, work: Callable[[Task], Any], yields: bool = False):
        super().__init__()
        self.name, self._yields = name, yields
        self.cancelled = threading.Event()
        self.result: Any = None
        self.error: BaseException | None = None
        self._work: Callable[[Task], Any] | None = work
        self._emits = True
        self._after_drop: Callable[[], object] | None = None
        self._thread = threading.Thread(target=self._run, name=name)
        self._message_posted.connect(self._pass_on, Qt.ConnectionType.QueuedConnection)
        self._end_posted.connect(self._finish, Qt.ConnectionType.QueuedConnection)

    @property
    def over(self) -> bool:
        """True if the thread has ended."""
        return self._thread.ident is not None and not self._thread.is_alive()

    @property
    def dropped(self) -> bool:
        """True after `drop` or `wait`: no more signals are emitted."""
        return not self._emits

    def start(self) -> None:
        """Start the thread; call it once."""
        _STARTED.add(self)
        self._thread.start()

    def report(self, message: Any) -> None:
        """Emit `reported`; called by the work, and seldom, as every message is delivered."""
        self._message_posted.emit(message)

    def cancel(self) -> None:
        """Ask the work to end; `ended` is emitted as usual."""
        self.cancelled.set()

    def drop(self, then: Callable[[], object] | None = None) -> None:
        """Ask the work to end, and emit no more signals.

        Parameters
        ----------
        then : callable, optional
            Called once, in the thread that made the task, when the work has ended or `wait_for_dropped` has given up.
        """
        self.cancel()
        self._emits, self._after_drop = False, then

    def call_after_drop(self) -> None:
        """Call the function passed to `drop`, once."""
        then, self._after_drop = self._after_drop, None
        if then is not None:
            then()

    def wait(self) -> None:
        """Wait for the thread, which must be about to end; no more signals are emitted."""
        self._emits = False
        self.join()

    def join(self, seconds: float | None = None) -> None:
        """Wait for the end of the thread, at most for a time if one is given; signals are emitted as usual."""
        self._thread.join(seconds)
        if self.over:
            self._work = None  # which may refer to this task: no cycle is left for another thread to collect
            _STARTED.discard(self)
            self.call_after_drop()

    def _run(self) -> None:
        try:
            if self._yields:
                # Imported with the kernels, which a first task loads.
                from hexmend_app.state.tasks.thread_priority import lower_priority

                lower_priority()
            self.result = self._work(self)
        except BaseException as error:  # the window reports errors of any kind
            self.error = error
        finally:
            self._end_posted.emit()

    def _pass_on(self, message: Any) -> None:
        if self._emits:
            self.reported.emit(message)

    def _finish(self) -> None:
        self.join()
        if self._emits:
            self.ended.emit()
