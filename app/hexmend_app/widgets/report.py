"""What to send to who is to mend the program: an error with where it came from, and the versions."""

from __future__ import annotations

import platform
import traceback

from hexmend import __version__


def report_of(error: BaseException) -> str:
    """An error as a text to be copied."""
    trace = "".join(traceback.format_exception(error)).rstrip()
    return f"{trace}\nhexmend {__version__}, Python {platform.python_version()}, {platform.platform()}"
