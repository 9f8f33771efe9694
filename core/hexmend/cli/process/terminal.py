"""What the terminal can show: one answer for everything that is printed."""

from __future__ import annotations

import os
import sys


def is_dumb() -> bool:
    """Return True if the terminal has said that it understands no control codes."""
    return os.environ.get("TERM", "").lower() in ("dumb", "unknown")


def shows_colours() -> bool:
    """Return True if standard output is printed in colours.

    NO_COLOR rules them out, FORCE_COLOR asks for them wherever the output goes; else it takes a terminal that is not
    dumb.
    """
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (sys.stdout.isatty() and not is_dumb())


def redraws_lines() -> bool:
    """Return True if standard error can show a line that changes in place: a colour code alone would not do."""
    return (sys.stderr.isatty() or bool(os.environ.get("FORCE_COLOR"))) and not is_dumb()
