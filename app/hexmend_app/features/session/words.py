"""What is said of work that a crash has left."""

from __future__ import annotations

from hexmend_app.state.recovery import Left


def said(left: Left) -> tuple[str, str]:
    """A title, and what there is and from when.

    >>> from datetime import datetime
    >>> from pathlib import Path
    >>> from PySide6.QtCore import QLockFile
    >>> said(Left(Path("a"), QLockFile("a/lock"), "five.vtu", 1, datetime(2026, 3, 1, 14, 5)))[0]
    'five.vtu can be recovered'
    """
    runs = "" if not left.runs else f", with {left.runs} run{'s' * (left.runs != 1)}"
    when = f"{left.when:%H:%M} on {left.when.day} {left.when:%B %Y}"
    return (
        f"{left.name or 'A mesh'} can be recovered",
        f"Hexmend ended unexpectedly while it was open. It was kept as it was at {when}{runs}.",
    )
