"""Signals that end a command, so that nothing is lost and nothing is left behind."""

from __future__ import annotations

import signal
import sys
import threading
from types import FrameType, TracebackType
from typing import Self

#: Ctrl-C, a polite request to end, and a terminal that has gone.
ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))


class Ended(KeyboardInterrupt):
    """A signal other than Ctrl-C has asked the program to end.

    Parameters
    ----------
    number : int
        Of the signal.
    """

    def __init__(self, number: int):
        super().__init__(number)
        self.number = number


def _raised(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt if number == signal.SIGINT else Ended(number)


class EndsCleanly:
    """Inside the block the signals in `ENDING` are exceptions: temporary files are removed on the way out."""

    def __enter__(self) -> Self:
        self._before = {}
        if threading.current_thread() is threading.main_thread():
            for number in ENDING:
                if signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
                    self._before[number] = signal.signal(number, self._handle)
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        _raised(number, frame)


class Asked(EndsCleanly):
    """Inside the block the first signal only asks: whoever loops looks at `asked`. The second is an exception.

    Nothing is thrown into the middle of an iteration, so that what was reached is whole.
    """

    def __init__(self):
        self.asked = False

    def _handle(self, number: int, frame: FrameType | None) -> None:
        if self.asked:
            _raised(number, frame)
        self.asked = True
        print("Ending with this iteration; a second Ctrl-C ends at once.", file=sys.stderr)
