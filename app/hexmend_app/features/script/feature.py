"""The script of what was done in the window: seen as it grows, copied, and saved."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QApplication
from superqt.utils import QSignalThrottler

from hexmend_app.feature import Action, Feature, Host, Panel, Place, Seen
from hexmend_app.features.script.script import Script
from hexmend_app.features.script.script_panel import ScriptPanel
from hexmend_app.state.run import Phase
from hexmend_app.state.scene import Page, Scene
from hexmend_app.widgets.questions import ask_script

#: Milliseconds between two looks while a run goes on.
_PERIOD = 300


class FeatureScript(Feature):
    """Shows what was done as Python, and gives it away."""

    order = 58

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = Seen()
        self.script = Script(self.session, self)
        self.script.scene = self._scene
        self.panel = ScriptPanel()
        self._soon = QSignalThrottler(parent=self.panel)
        self._soon.setTimeout(_PERIOD)
        self._soon.triggered.connect(self._show)
        self.panel.anew_requested.connect(self.script.begin_anew)
        self.script.changed.connect(host.refresh_soon)
        self.panel.copy_requested.connect(self.copy)
        self.panel.save_requested.connect(self.ask)

    def actions(self) -> Sequence[Action]:
        """Save the script."""
        return (
            Action(
                id="script",
                text="Save scr&ipt…",
                menu="File",
                part=1,
                icon="script-text-outline",
                help="Save what was done in this window as a Python file that does it again.",
                handle=self.ask,
                enabled=lambda: self.session.document.is_open or bool(self.script.entries),
                needs_mesh=False,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """What was done."""
        return (
            Panel(
                id="script",
                title="Script",
                widget=self.panel,
                place=Place.DRAWER,
                order=70,
                help="What was done in this window, as Python that does it again.",
            ),
        )

    def refresh(self) -> None:
        """Show what has been done since and what is seen, where somebody looks: while a run goes on, now and then."""
        if not self.panel.isVisible():
            return
        if self.session.smoothing.phase is Phase.RUNNING:
            self._soon.throttle()
        else:
            self._soon.cancel()
            self._show()

    def _show(self) -> None:
        text = self.script.text
        if self._seen.another("script", text):
            self.panel.show_text(text)

    def _scene(self) -> Scene | None:
        """What is seen; None before anything is drawn."""
        canvas = self.canvas
        if canvas is None or canvas.viewport.frame is None:
            return None
        return canvas.scene(Page(), self.session.cameras.all)

    def copy(self) -> None:
        """Copy the script."""
        QApplication.clipboard().setText(self.script.text)
        self.host.messages.show_info("The script was copied.")

    def ask(self) -> None:
        """Ask where the script goes and write it."""
        path = ask_script(self.host.dialog_parent, self.host.stem)
        if path:
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the script; whether it was."""
        return self.host.said("The script was not saved", lambda: self.script.write(path), f"Script saved to {path}")
