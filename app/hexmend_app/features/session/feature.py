"""Sessions: the mesh with all that the window keeps of it, saved to one file; and the way back after a crash."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.run import Phase
from hexmend_app.widgets.questions import ask_session


class FeatureSession(Feature):
    """Saves sessions and opens them."""

    order = 12

    def __init__(self, host: Host):
        super().__init__(host)

    def actions(self) -> Sequence[Action]:
        """Save and open."""
        return (
            Action(
                id="save_session",
                text="Save sess&ion as…",
                menu="File",
                part=1,
                keys="Ctrl+Shift+S",
                icon="content-save-all-outline",
                help="Save the mesh with its view, runs, recipe, tags and comparisons as one file, to go on later.",
                handle=self.ask,
                enabled=self._savable,
            ),
        )

    def ask(self) -> bool:
        """Ask where the session goes and write it; whether it was."""
        path = ask_session(self.host.window, self.host.stem)
        return bool(path) and self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the session; whether it was."""
        save = self.session.commands.save
        return self.host.said("The session was not saved", lambda: save(path), f"Session saved to {path}")

    def _savable(self) -> bool:
        smoothing = self.session.smoothing
        return not self.session.opener.busy and (not smoothing.busy or smoothing.phase is Phase.PAUSED)
