"""Script of the changes of the mesh: shown, copied and saved."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QApplication

from hexmend.report.documents import write_text
from hexmend_app.feature import Action, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.script.script_panel import ScriptPanel
from hexmend_app.features.script.trace import Trace
from hexmend_app.picture import Page, Scene
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_script


class FeatureScript(Feature):
    """Shows the changes of the mesh as a Python script."""

    order = 58

    def __init__(self, host: Host):
        super().__init__(host)
        self.panel = ScriptPanel()
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
                help=tr("Save the changes of the mesh as a Python script."),
                handle=self.ask,
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
                help=tr("The changes of the mesh as a Python script."),
            ),
        )

    def refresh(self) -> None:
        """Show the script if the panel is visible, unless a run is active."""
        if self.panel.isVisible() and self.session.run.phase is not Phase.RUNNING:
            self.panel.show_text(self.text)

    @property
    def text(self) -> str:
        """The script, with the scene of the view at its end."""
        return Trace(self.session).text(self._scene())

    def _scene(self) -> Scene | None:
        """Return the scene of the view; None before the first picture."""
        canvas = self.canvas
        if canvas is None or canvas.viewport.frame is None:
            return None
        return canvas.scene(Page(), self.session.saved_cameras.all)

    def copy(self) -> None:
        """Copy the script."""
        QApplication.clipboard().setText(self.text)
        self.host.messages.show_info(tr("Script copied."))

    def ask(self) -> None:
        """Ask for a path and save the script."""
        path = ask_script(self.host.dialog_parent, self.host.stem)
        if path:
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the script; return True if it was written."""
        return self.host.try_and_report(
            tr("Script not saved"),
            lambda: write_text(Path(path), self.text),
            tr("Script saved to {path}", path=path),
        )
