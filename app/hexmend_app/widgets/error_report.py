"""Error report for developers: traceback and versions."""

from __future__ import annotations

import platform
import traceback

from hexmend import __version__


def report_of(error: BaseException) -> str:
    """Return the traceback of an error and the versions of Hexmend, Python and the platform as text."""
    trace = "".join(traceback.format_exception(error)).rstrip()
    return f"{trace}\nhexmend {__version__}, Python {platform.python_version()}, {platform.platform()}"
