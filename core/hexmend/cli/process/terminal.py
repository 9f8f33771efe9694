"""Abilities of the terminal: colours, and lines that change in place."""

from __future__ import annotations

import os
import sys

from hexmend.terminal_text import is_dumb


def shows_colours() -> bool:
    """Return True if standard output is printed in colours.

    NO_COLOR switches colours off; FORCE_COLOR switches them on for any output; else a terminal that is not dumb has
    them.
    """
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (sys.stdout.isatty() and not is_dumb())


def redraws_lines() -> bool:
    """Return True if standard error can show a line that changes in place."""
    return (sys.stderr.isatty() or bool(os.environ.get("FORCE_COLOR"))) and not is_dumb()
