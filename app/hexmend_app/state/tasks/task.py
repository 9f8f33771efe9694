"""Work beside the window: a callable in a thread that has a name, can be called off, and reports once."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

#: Tasks that have begun and whose owners have neither heard of their end nor waited for it. It keeps them alive, so
#: that none is taken down by the thread that it runs in.
_BEGUN: set[Task] = set()


#: Seconds that whoever closes waits for threads that were asked to end.
GRACE = 2.0


def running() -> tuple[Task, ...]:
    """The tasks whose threads have not ended, by name."""
    return tuple(sorted((task for task in _BEGUN if not task.over), key=lambda task: task.name))


def drop(task: Task | None) -> None:
    """Drop a task, if there is one."""
    if task is not None:
        task.drop()


def wait_for_dropped() -> None:
    """Wait for the threads of all tasks that were dropped, for `GRACE` seconds in all.

    No thread can be ended from outside: one that reads from a network drive that does not answer goes on, and is among
    `running`. A program that is about to end then ends its process.
    """
    deadline = time.monotonic() + GRACE
    for task in [one for one in _BEGUN if one.dropped]:
        task.join(max(0.0, deadline - time.monotonic()))
        task.let_go()


class Task(QObject):
    """Does one piece of work in a thread of its own.

    It belongs to the thread that makes it, and so do its signals: they are queued there, whoever listens.

    Parameters
    ----------
    name : str
        The thread's, as `threading.enumerate` and a debugger show it.
    work : callable
        Called in the thread with this task. What it returns is `result`, what it raises is `error`; once `cancelled` is
        set it should return soon, which nobody else can make it do.
    yields : bool
        Whether the window goes first, as it should where the work takes seconds.

    Attributes
    ----------
    name : str
    cancelled : threading.Event
    result
        What the work returned; None until it is over.
    error : BaseException or None
        What the work raised.

    Signals
    -------
    told(object)
        What the work has told, in that order.
    ended
        The work is over. The last signal, and the only one where the work told nothing.
    """

    reported = Signal(object)
    ended = Signal()
    _tells = Signal(object)
    _ends = Signal()

    def __init__(self, name: str, work: Callable[[Task], Any], *, yields: bool = False):
        super().__init__()
        self.name = name
        self.cancelled = threading.Event()
        self.result: Any = None
        self.error: BaseException | None = None
        self._work: Callable[[Task], Any] | None = work
        self._yields = yields
        self._listened_to = True
        self._then: Callable[[], object] | None = None  # called when it was dropped and has ended
        self._thread = threading.Thread(target=self._run, name=name)
        self._tells.connect(self._pass_on, Qt.ConnectionType.QueuedConnection)
        self._ends.connect(self._finish, Qt.ConnectionType.QueuedConnection)

    @property
    def over(self) -> bool:
        """True if the thread has begun and ended."""
        return self._thread.ident is not None and not self._thread.is_alive()

    @property
    def dropped(self) -> bool:
        """True if the result is no longer wanted."""
        return not self._listened_to

    def start(self) -> None:
        """Begin; once."""
        _BEGUN.add(self)
        self._thread.start()

    def tell(self, message: Any) -> None:
        """Say something to whoever listens to `told`; from the work, and seldom: every message is delivered."""
        self._tells.emit(message)

    def cancel(self) -> None:
        """Ask the work to end; its end is reported as usual."""
        self.cancelled.set()

    def drop(self, then: Callable[[], object] | None = None) -> None:
        """Ask the work to end, and hear no more of it.

        Parameters
        ----------
        then : callable, optional
            Called once, in the thread that made the task, when the work has ended or `wait_for_dropped` has given up.
        """
        self.cancel()
        self._listened_to, self._then = False, then

    def let_go(self) -> None:
        """Call what was to be called after the end of the work, whether it has ended or not."""
        then, self._then = self._then, None
        if then is not None:
            then()

    def wait(self) -> None:
        """Wait until the thread has ended, which it must be about to; no signal comes after that."""
        self._listened_to = False
        self.join()

    def join(self, seconds: float | None = None) -> None:
        """Wait until the thread has ended, or so many seconds; what it tells is heard as before."""
        self._thread.join(seconds)
        if self.over:
            self._work = None  # which may know this task: no circle is left for another thread to collect
            _BEGUN.discard(self)
            self.let_go()

    def _run(self) -> None:
        try:
            if self._yields:
                from hexmend_app.state.tasks.thread_priority import (
                    lower_priority,  # with the kernels, which a first task loads
                )

                lower_priority()
            self.result = self._work(self)
        except BaseException as error:  # whatever it is, the window has to say it
            self.error = error
        finally:
            self._ends.emit()

    def _pass_on(self, message: Any) -> None:
        if self._listened_to:
            self.reported.emit(message)

    def _finish(self) -> None:
        self.join()
        if self._listened_to:
            self.ended.emit()
