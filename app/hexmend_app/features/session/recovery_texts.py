"""Texts of the offer to recover a session after a crash."""

from __future__ import annotations

from hexmend_app.state.session.recovery import RecoveredSession
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted


def recovery_offer(crashed: RecoveredSession) -> tuple[str, str]:
    """Return the title and text of the offer to recover a session.

    >>> from datetime import datetime
    >>> from pathlib import Path
    >>> from PySide6.QtCore import QLockFile
    >>> recovery_offer(RecoveredSession(Path("a"), QLockFile("a/lock"), "five.vtu", 1, datetime(2026, 3, 1, 14, 5)))[0]
    'five.vtu can be recovered'
    """
    runs = "" if not crashed.runs else tr(", with {runs}", runs=counted(crashed.runs, "run"))
    when = tr("{time} on {date}", time=f"{crashed.when:%H:%M}", date=f"{crashed.when.day} {crashed.when:%B %Y}")
    return (
        tr("{name} can be recovered", name=crashed.name or tr("A mesh")),
        tr(
            "Hexmend ended unexpectedly while this mesh was open. Last autosave: {when}{runs}.",
            when=when,
            runs=runs,
        ),
    )
