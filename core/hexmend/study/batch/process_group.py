"""Groups of processes: a process with all that it started is ended at once."""

from __future__ import annotations

import os
import signal
from contextlib import suppress


def end_group(number: int) -> None:
    """End the leader of a process group and all of the group; does nothing if it has ended.

    Parameters
    ----------
    number : int
        Process id of the leader.
    """
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(number, signal.SIGKILL)
        else:
            os.kill(number, signal.SIGTERM)
