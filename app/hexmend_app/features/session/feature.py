"""Sessions: the mesh with all that the window keeps of it, saved to one file; and the way back after a crash."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.session.words import said
from hexmend_app.state.recovery import Left, Recovery
from hexmend_app.state.run import Phase
from hexmend_app.widgets.questions import ask_session


class FeatureSession(Feature):
    """Saves sessions, keeps what is open safe from a crash, and offers what a crash has left.

    Attributes
    ----------
    recovery : Recovery
        It rests until `guard` is called.
    """

    order = 12

    def __init__(self, host: Host):
        super().__init__(host)
        self.recovery = Recovery(self.session, self)
        self.recovery.failed.connect(self._on_failed)
        self._failed = False
        self._offered: set[Left] = set()

    def actions(self) -> Sequence[Action]:
        """Save, and recover."""
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
            Action(
                id="recover",
                text="&Recover a session…",
                menu="File",
                help="Open what a window had kept that ended unexpectedly.",
                needs_mesh=False,
                handle=lambda: self._offer(self.recovery.left[0]),
                enabled=lambda: bool(self.recovery.left) and not self.session.opener.busy,
            ),
        )

    def guard(self) -> None:
        """Keep what is open safe from a crash from now on, and offer what one has left."""
        self.recovery.begin()
        self.host.refresh_soon()

    def refresh(self) -> None:
        """Offer what was left, each once, when nothing is being opened: a mesh that opens takes all messages away."""
        for left in self.recovery.left[:1]:
            if left not in self._offered and not self.session.opener.busy:
                self._offered.add(left)
                self._offer(left)

    def close(self) -> None:
        """The window ends in order."""
        self.recovery.end()

    def ask(self) -> None:
        """Ask where the session goes, and begin to write it."""
        path = ask_session(self.host.dialog_parent, self.host.stem)
        if path:
            self.session.commands.save_in_background(path)

    def _offer(self, left: Left) -> None:
        choices = (("Recover", lambda: self._recover(left)), ("Discard", lambda: self._forget(left)))
        self.host.messages.show_offer(*said(left), choices)

    def _recover(self, left: Left) -> None:
        if left in self.recovery.left and self.host.may_leave():
            self.recovery.take_up(left)

    def _forget(self, left: Left) -> None:
        if left in self.recovery.left:
            self.recovery.forget(left)
        self.host.refresh_soon()

    def _on_failed(self, error: Exception) -> None:
        if not self._failed:  # it will fail again every few minutes
            self._failed = True
            self.host.messages.show_warning(
                "What you do is not kept safe from a crash",
                f"The session could not be written beside the window: {error} Save it where there is room.",
            )

    def _savable(self) -> bool:
        smoothing = self.session.smoothing
        return not self.session.opener.busy and (not smoothing.busy or smoothing.phase is Phase.PAUSED)
