"""A timer that sends a signal again, for systems without SIGALRM (Windows)."""

from __future__ import annotations

import _thread
import signal
import time

#: Number of times that the timer was set; a thread that finds another number than its own was cancelled.
_count = 0

#: True while the timer sends its signal.
_sending = False


def send_later(number: int, seconds: float) -> None:
    """Send a signal to this process after some time; a timer that was set before is cancelled.

    Parameters
    ----------
    number : int
        The signal.
    seconds : float
        With 0 the timer is only cancelled.
    """
    global _count, _sending
    _count, _sending = _count + 1, False
    if seconds:  # not `threading`: the interrupted code may hold its locks
        _thread.start_new_thread(_send, (number, seconds, _count))


def send_now(number: int) -> None:
    """Send a signal to this process now in place of the timer, which is cancelled.

    Parameters
    ----------
    number : int
        The signal.
    """
    global _count, _sending
    _count, _sending = _count + 1, True
    signal.raise_signal(number)


def comes_from_timer() -> bool:
    """Return True if the timer has sent the signal; to be called once in the handler of each signal."""
    global _sending
    sent, _sending = _sending, False
    return sent


def _send(number: int, seconds: float, count: int) -> None:
    time.sleep(seconds)
    if count == _count:
        send_now(number)
