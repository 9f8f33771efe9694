"""Sessions saved to one file, and recovery after a crash."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.session.recovery import RecoveredSession, Recovery
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_session


class FeatureSession(Feature):
    """Saves and autosaves sessions, and offers to recover them after a crash.

    Attributes
    ----------
    recovery : Recovery
        Inactive until `program_started` is called.
    """

    def __init__(self, host: Host):
        super().__init__(host)
        self.recovery = Recovery(self.session, self)
        self.recovery.failed.connect(self._on_failed)
        # Later, because opening a file clears the messages.
        self.session.feature_states.failed.connect(self._on_state_failed, Qt.ConnectionType.QueuedConnection)
        self._failed = False
        self._offered: set[RecoveredSession] = set()

    def actions(self) -> Iterable[Action]:
        """Yield the actions that save and recover a session."""
        yield Action(
            id="save_session",
            text=tr("Save sess&ion as…"),
            menu="File",
            section=1,
            keys="Ctrl+Alt+S",
            icon="content-save-all-outline",
            help=tr("Save the mesh, view, runs, recipe, tags and comparisons to one file, to continue later."),
            handle=self.ask,
            enabled=lambda: self.session.savable,
        )
        yield Action(
            id="recover",
            text=tr("&Recover session…"),
            menu="File",
            help=tr("Open an autosaved session after a crash."),
            needs_mesh=False,
            handle=lambda: self._offer(self.recovery.recoverable[0]),
            enabled=lambda: bool(self.recovery.recoverable) and not self.session.opener.busy,
        )

    def program_started(self) -> None:
        """Start autosaving, and offer sessions left by a crash."""
        self.recovery.begin()
        self.host.refresh_soon()

    def refresh(self) -> None:
        """Offer each recoverable session once, unless a mesh is opening, which would clear the messages."""
        for crashed in self.recovery.recoverable[:1]:
            if crashed not in self._offered and not self.session.opener.busy:
                self._offered.add(crashed)
                self._offer(crashed)

    def close(self) -> None:
        """End autosaving; the window closes normally."""
        self.recovery.end()

    def ask(self) -> None:
        """Ask for a path and save the session in the background."""
        path = ask_session(self.host.dialog_parent, self.host.default_file_stem)
        if path:
            self.session.commands.save_in_background(path)

    def _offer(self, crashed: RecoveredSession) -> None:
        buttons = ((tr("Recover"), lambda: self._recover(crashed)), (tr("Discard"), lambda: self._discard(crashed)))
        self.host.messages.show_warning(*recovery_offer(crashed), buttons)

    def _recover(self, crashed: RecoveredSession) -> None:
        if crashed in self.recovery.recoverable and self.host.confirm_close():
            self.recovery.recover(crashed)

    def _discard(self, crashed: RecoveredSession) -> None:
        if crashed in self.recovery.recoverable:
            self.recovery.discard(crashed)
        self.host.refresh_soon()

    def _on_state_failed(self, name: str, error: Exception) -> None:
        problem = tr(
            "Invalid data for “{name}” in the session file: {error}. Everything else was restored.",
            name=name,
            error=str(error).rstrip("."),
        )
        self.host.messages.show_error(tr("Part of the session was not restored"), problem)

    def _on_failed(self, error: Exception) -> None:
        if not self._failed:  # report it once, not at every autosave
            self._failed = True
            self.host.messages.show_warning(
                tr("Autosave failed"), tr("{error} Save the session to another disk or folder.", error=error)
            )


def recovery_offer(crashed: RecoveredSession) -> tuple[str, str]:
    """Return the title and text of the offer to recover a session.

    >>> from datetime import datetime
    >>> from pathlib import Path
    >>> from PySide6.QtCore import QLockFile
    >>> recovery_offer(RecoveredSession(Path("five.vtu.hexmend"), QLockFile("lock"), datetime(2026, 3, 1, 14, 5)))[0]
    'five.vtu can be recovered'
    """
    when = tr("{time} on {date}", time=f"{crashed.when:%H:%M}", date=f"{crashed.when.day} {crashed.when:%B %Y}")
    return (
        tr("{name} can be recovered", name=crashed.name),
        tr("Hexmend ended unexpectedly while this mesh was open. Last autosave: {when}.", when=when),
    )
