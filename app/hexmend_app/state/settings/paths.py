"""Folder of the program's internal state, such as autosaves."""

from __future__ import annotations

import os
import sys
from pathlib import Path

#: Environment variable that overrides the folder.
VARIABLE = "HEXMEND_STATE"


def state_folder() -> Path:
    """Return the state folder of the user by the convention of the system; it may not exist yet."""
    if override := os.environ.get(VARIABLE):
        return Path(override).absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "Hexmend"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Hexmend"
    base = Path(os.environ.get("XDG_STATE_HOME") or "")
    return (base if base.is_absolute() else Path.home() / ".local" / "state") / "hexmend"  # relative paths are ignored
