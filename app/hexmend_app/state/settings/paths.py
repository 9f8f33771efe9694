"""Folder of the program's state that is neither a setting nor a file of the user."""

from __future__ import annotations

import os
import sys
from pathlib import Path

#: Names another folder.
VARIABLE = "HEXMEND_STATE"


def state_folder() -> Path:
    """The folder, which may not be there yet: where each system has such things, for the user who is logged in."""
    if own := os.environ.get(VARIABLE):
        return Path(own).absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "Hexmend"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Hexmend"
    base = Path(os.environ.get("XDG_STATE_HOME") or "")
    return (base if base.is_absolute() else Path.home() / ".local" / "state") / "hexmend"  # relative ones do not count
