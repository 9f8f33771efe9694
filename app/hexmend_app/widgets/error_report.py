"""Error report for the developers: traceback and versions."""

from __future__ import annotations

import platform
import traceback

from hexmend import __version__


def report_of(error: BaseException) -> str:
    """An error as text to copy."""
    trace = "".join(traceback.format_exception(error)).rstrip()
    return f"{trace}\nhexmend {__version__}, Python {platform.python_version()}, {platform.platform()}"
