"""A timer that sends a signal again, for systems without SIGALRM (Windows)."""

from __future__ import annotations

import _thread
import signal
import time

#: How often the timer has been set: a thread that finds another number here than its own is out of date.
_count = 0

#: Whether the next signal comes from the timer.
_rings = False


def send_later(number: int, seconds: float) -> None:
    """Send a signal to this process after some time; the time that was set before is cancelled.

    Parameters
    ----------
    number : int
        The signal.
    seconds : float
        0 only cancels.
    """
    global _count, _rings
    _count, _rings = _count + 1, False
    if seconds:  # `threading` takes locks, and the code that a handler has interrupted may hold these
        _thread.start_new_thread(_send, (number, seconds, _count))


def send_now(number: int) -> None:
    """Send a signal to this process as the timer does; that is cancelled.

    Parameters
    ----------
    number : int
        The signal.
    """
    global _count, _rings
    _count, _rings = _count + 1, True
    signal.raise_signal(number)


def comes_from_timer() -> bool:
    """Return True if the signal that a handler was called for is the timer's; ask once for each signal."""
    global _rings
    rings, _rings = _rings, False
    return rings


def _send(number: int, seconds: float, count: int) -> None:
    time.sleep(seconds)
    if count == _count:
        send_now(number)
