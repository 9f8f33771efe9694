"""Handling of the signals that ask the program to end: Ctrl-C, TERM, or a terminal that closes.

A handler never prints, because it may have interrupted a print. It sets a flag, writes with `os.write`, or raises
`KeyboardInterrupt`; within a function that is `uninterrupted` that waits until the function returns.

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

#: True in the program `hexmend`, False in a process that only calls its `main`.
_is_program = False

#: The signal whose exception waits for the end of a function that is `uninterrupted`; 0 for none.
_waiting = 0


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
    """Inside the block a signal is an exception: temporary files are removed on the way out.

    Parameters
    ----------
    completes : bool
        Ignore signals after the block if it ends without an exception: nothing is left to interrupt.

    Attributes
    ----------
    number : int
        The first signal that came; 0 if none did.
    """

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
        self._count = 0
        try:
            for number in ENDING:
                if signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._on_signal)
        except ValueError:  # only the main thread may set handlers
            pass
        return self

    @uninterrupted  # else some of the handlers could stay
    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        global _waiting
        ignored = kind is None and self.completes and _is_program
        for number, handler in self._before.items():
            signal.signal(number, signal.SIG_IGN if ignored else handler)
        if kind is not None or self.completes:
            _waiting = 0

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        self._count += 1
        self.number = self.number or number
        self._answer(self._count, number, frame)

    def _answer(self, count: int, number: int, frame: FrameType | None) -> None:
        """React to a signal; `count` is 1 for the first of the block."""
        global _waiting
        if not is_interruptible(frame):
            _waiting = number
        else:
            raise _exception(number)


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
    """Inside the block the result is written: the first signal is ignored, the second is an exception."""

    def __init__(self):
        super().__init__(completes=True)

    def _answer(self, count: int, number: int, frame: FrameType | None) -> None:
        if count == 1:
            write_line("Writing the result; a second Ctrl-C ends at once, and an older file stays as it was.")
        else:
            super()._answer(count - 1, number, frame)


def _exception(number: int) -> KeyboardInterrupt:
    """Make the exception of a signal."""
    return KeyboardInterrupt() if number == signal.SIGINT else TerminationSignal(number)


def _raise_waiting() -> None:
    """Raise the exception that was waiting for the end of an `uninterrupted` function."""
    global _waiting
    if _waiting and is_interruptible(sys._getframe()):
        number, _waiting = _waiting, 0
        raise _exception(number)


ON_RETURN.append(_raise_waiting)
