"""Processes with all that they start: begun apart from what the terminal signals, ended at once."""

from __future__ import annotations

import os
import signal
from contextlib import suppress


def end_group(number: int) -> None:
    """End a process that leads a group, and all of its group; nothing happens where it has ended.

    Parameters
    ----------
    number : int
        Of the process.
    """
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(number, signal.SIGKILL)
        else:
            os.kill(number, signal.SIGTERM)
