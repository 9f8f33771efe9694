"""Lower priority for threads that compute, so that the window stays responsive."""

from __future__ import annotations

import contextlib
import os
import sys
import threading

from hexmend.kernels import set_threads, threads

#: Nice value of threads that compute, in addition to that of the process.
_NICE = 10


def lower_priority() -> None:
    """Lower the priority of the calling thread, and leave one core to the window.

    Call it before the first kernel of the thread, whose helper threads inherit the priority. Results do not depend on
    the number of threads.
    """
    set_threads(max(1, threads() - 1))
    if sys.platform == "linux":  # elsewhere the number of a thread is no process, or another process
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), os.getpriority(os.PRIO_PROCESS, 0) + _NICE)
