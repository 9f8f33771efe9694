"""Handling of the signals that ask the program to end: Ctrl-C, TERM, or a terminal that closes.

A handler never prints, because it may have interrupted a print. It sets a flag, writes with `os.write`, or raises
`KeyboardInterrupt`. Within an import, a callback or a function that is `uninterrupted` the exception would be lost: it
is raised afterwards.

Before a command runs there is nothing to lose, and the process exits at once (`exit_on_signals`). A command runs in
`CleanExit`, a loop in `ExitAfterIteration`, and results are written in `FinishWriting`.
"""

from __future__ import annotations

import os
import signal
import sys

from hexmend.signal_guard import ON_RETURN, is_interruptible, uninterrupted
from hexmend.terminal_text import is_dumb

TYPE_CHECKING = False  # `typing` would cost as much as `--version` does
if TYPE_CHECKING:
    from types import FrameType, TracebackType
    from typing import Any, NoReturn, Self

#: Ctrl-C, a request to terminate, and a terminal that was closed.
ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))

#: The signal of the timer; None on Windows, where every exception is raised at once.
_ALARM = getattr(signal, "SIGALRM", None)

#: Seconds until the next attempt to raise an exception that would have been lost.
_RETRY = 0.02

#: True in the program `hexmend`, False in a process that only calls its `main`.
_is_program = False

#: The signal that the timer will send; 0 if it is not set.
_delayed = 0

#: True if the timer waits for a place where an exception can be raised, False if for the end of a grace period.
_retries = False


class TerminationSignal(KeyboardInterrupt):
    """A signal other than Ctrl-C has asked the program to end.

    Parameters
    ----------
    number : int
        The signal's number.
    """

    def __init__(self, number: int):
        super().__init__(number)
        self.number = number


def exit_on_signals() -> None:
    """Let signals end this process with one line and their exit status; called first of all by the program."""
    global _is_program
    if not _is_program:
        _is_program = True
        for number in ENDING:
            if signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
                signal.signal(number, exit_interrupted)


def exit_interrupted(number: int, frame: FrameType | None = None) -> NoReturn:
    """End the process at once; while Python shuts down, a further signal would change the exit status.

    Parameters
    ----------
    number : int
        The signal's number.
    frame : frame, optional
        Not used; handlers of signals are called with it.
    """
    write_line("hexmend: interrupted")
    os._exit(128 + number)


def write_line(text: str) -> None:
    """Write a line to standard error without Python's buffers, which a handler must not use."""
    erase = "\r\x1b[2K" if os.isatty(2) and not is_dumb() else ""  # a line of progress may be there
    try:  # noqa: SIM105 (contextlib would be loaded before the program can be interrupted)
        os.write(2, f"{erase}{text}\n".encode())
    except OSError:  # standard error is closed
        pass


class CleanExit:
    """Inside the block a signal is an exception; a further one waits until temporary files are removed on the way out.

    Parameters
    ----------
    completes : bool
        Ignore signals after the block if it ends without an exception: nothing is left to interrupt.

    Attributes
    ----------
    number : int
        The first signal that came; 0 if none did.
    """

    #: Seconds for which a further signal waits at most.
    grace = 2.0

    def __init__(self, completes: bool = False):
        self.completes = completes
        self.number = 0

    @property
    def asked(self) -> bool:
        """Return True once a signal has asked the program to end."""
        return self.number != 0

    @property
    def status(self) -> int:
        """The exit status of a command that was interrupted: 128 and the signal's number."""
        return 128 + (self.number or signal.SIGINT)

    def __enter__(self) -> Self:
        self._before: dict[int, Any] = {}
        self._count, self._delays = 0, False
        self._unraisable, sys.unraisablehook = sys.unraisablehook, self._on_unraisable
        try:
            if _ALARM is not None:
                self._before[_ALARM] = signal.signal(_ALARM, self._on_alarm)
            for number in ENDING:
                if signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._on_signal)
        except ValueError:  # only the main thread may set handlers
            pass
        return self

    @uninterrupted  # else some of the handlers could stay
    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        alarm = self._before.pop(_ALARM, None)
        ignored = kind is None and self.completes and _is_program
        for number, handler in self._before.items():  # first, because a signal that comes here sets the timer
            signal.signal(number, signal.SIG_IGN if ignored else handler)
        waiting = _delayed if self._delays else 0
        if self._delays:
            self._delay(0, 0.0)
        if alarm is not None:
            signal.signal(_ALARM, alarm)
        sys.unraisablehook = self._unraisable
        if waiting and kind is None and not self.completes:
            signal.raise_signal(waiting)  # to the block around this one

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        self._count += 1
        self.number = self.number or number
        self._answer(self._count, number, frame)

    def _answer(self, count: int, number: int, frame: FrameType | None) -> None:
        """React to a signal; `count` is 1 for the first of the block."""
        if count == 1:
            self._raise(number, frame)
        else:
            self._wait(number)

    def _raise(self, number: int, frame: FrameType | None) -> None:
        """Raise an exception, or set the timer if it would be lost now."""
        if _ALARM is not None and not is_interruptible(frame):
            self._delay(number, _RETRY, retries=True)
            return
        if self._delays:
            self._delay(0, 0.0)
        raise KeyboardInterrupt if number == signal.SIGINT else TerminationSignal(number)

    def _wait(self, number: int) -> None:
        """Raise an exception if the block has not ended after the grace."""
        if _ALARM is None:
            self._raise(number, None)
        elif not (self._delays and _delayed):
            self._delay(number, self.grace)

    def _delay(self, number: int, seconds: float, retries: bool = False) -> None:
        global _delayed, _retries
        _delayed, _retries, self._delays = number, retries, number != 0
        signal.setitimer(signal.ITIMER_REAL, seconds)

    def _on_alarm(self, alarm: int, frame: FrameType | None) -> None:
        global _delayed
        number, _delayed = _delayed, 0
        if number and self._delays:
            self._raise(number, frame)
        elif number:  # the timer was set by the block around this one
            self._on_signal(number, frame)

    def _on_unraisable(self, unraisable: Any) -> None:
        """Raise again an exception that was lost in a callback, such as `__del__`."""
        if isinstance(unraisable.exc_value, KeyboardInterrupt) and _ALARM is not None:
            self._delay(getattr(unraisable.exc_value, "number", signal.SIGINT), _RETRY, retries=True)
        else:
            self._unraisable(unraisable)


class ExitAfterIteration(CleanExit):
    """Inside the block the first signal only sets `asked`, which the loop checks; the second is an exception.

    So no iteration is interrupted, and its result is complete.

    Parameters
    ----------
    quiet : bool
        Write no message: another process does.
    """

    def __init__(self, quiet: bool = False):
        super().__init__()
        self._quiet = quiet

    def _answer(self, count: int, number: int, frame: FrameType | None) -> None:
        if count == 1 and not self._quiet:
            write_line("Ending after this iteration; a second Ctrl-C ends at once.")
        elif count > 1:
            super()._answer(count - 1, number, frame)


class FinishWriting(CleanExit):
    """Inside the block the result is written: the first signal is ignored, the second limits the time for writing."""

    grace = 8.0

    def __init__(self):
        super().__init__(completes=True)

    def _answer(self, count: int, number: int, frame: FrameType | None) -> None:
        if count == 1:
            write_line(f"Writing the result; after a second Ctrl-C it has {self.grace:g} s left.")
        else:
            self._wait(number)


def _raise_waiting() -> None:
    """Raise the exception that was waiting for the end of an `uninterrupted` function."""
    if _delayed and _retries:
        signal.raise_signal(_ALARM)


ON_RETURN.append(_raise_waiting)
