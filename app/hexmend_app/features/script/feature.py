"""Script of the actions in the window: shown, copied and saved."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QApplication
from superqt.utils import QSignalThrottler

from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.script.script import Script
from hexmend_app.features.script.script_panel import ScriptPanel
from hexmend_app.picture import Page, Scene
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_script

#: Milliseconds between two updates during a run.
_PERIOD = 300


class FeatureScript(Feature):
    """Shows the actions in the window as a Python script."""

    order = 58
    shows_iterations = True

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self.script = Script(self.session, self)
        self.script.scene = self._scene
        self.panel = ScriptPanel()
        self._soon = QSignalThrottler(parent=self.panel)
        self._soon.setTimeout(_PERIOD)
        self._soon.triggered.connect(self._show)
        self.panel.restart_requested.connect(self.script.restart)
        self.script.changed.connect(host.refresh_soon)
        self.panel.copy_requested.connect(self.copy)
        self.panel.save_requested.connect(self.ask)

    def actions(self) -> Sequence[Action]:
        """Return the action that saves the script."""
        return (
            Action(
                id="script",
                text=tr("Save scr&ipt…"),
                menu="File",
                part=1,
                icon="script-text-outline",
                help=tr("Save the actions of this window as a Python script that repeats them."),
                handle=self.ask,
                enabled=lambda: self.session.document.is_open or bool(self.script.entries),
                needs_mesh=False,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """Return the script panel."""
        return (
            Panel(
                id="script",
                title=tr("Script"),
                widget=self.panel,
                place=PanelPlace.DRAWER,
                group=PanelGroup.REPORT,
                order=70,
                help=tr("The actions of this window as a Python script that repeats them."),
            ),
        )

    def refresh(self) -> None:
        """Update the script if the panel is visible; throttled during a run."""
        if not self.panel.isVisible():
            return
        if self.session.run.phase is Phase.RUNNING:
            self._soon.throttle()
        else:
            self._soon.cancel()
            self._show()

    def _show(self) -> None:
        text = self.script.text
        if self._seen.changed("script", text):
            self.panel.show_text(text)

    def _scene(self) -> Scene | None:
        """Return the scene of the view; None before the first picture."""
        canvas = self.canvas
        if canvas is None or canvas.viewport.frame is None:
            return None
        return canvas.scene(Page(), self.session.saved_cameras.all)

    def copy(self) -> None:
        """Copy the script."""
        QApplication.clipboard().setText(self.script.text)
        self.host.messages.show_info(tr("Script copied."))

    def ask(self) -> None:
        """Ask for a path and save the script."""
        path = ask_script(self.host.dialog_parent, self.host.stem)
        if path:
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the script; return True if it was written."""
        return self.host.try_and_report(
            tr("Script not saved"), lambda: self.script.write(path), tr("Script saved to {path}", path=path)
        )
