"""Priority of threads that compute: below that of the window."""

from __future__ import annotations

import contextlib
import os
import sys
import threading

from hexmend.kernels import set_threads, threads

#: How far such a thread stands back behind the window, as `nice` counts.
_NICE = 10


def lower_priority() -> None:
    """Let the window go first, from the thread that calls this on: a frame that waits is seen, a step is not.

    One core stays with the window; results do not depend on the number of threads. To be called before the thread's
    first kernel: the threads that help it have its priority as it was when they were made.
    """
    set_threads(max(1, threads() - 1))
    if sys.platform == "linux":  # elsewhere a thread's number is none of a process, or that of another process
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), _NICE)
