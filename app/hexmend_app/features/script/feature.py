"""Script of the changes of the mesh: shown, copied and saved."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QApplication, QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend.report.documents import write_text
from hexmend_app.feature import Action, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.script.trace import Trace
from hexmend_app.picture import Page, Scene
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, note, set_help
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


class ScriptPanel(QWidget):
    """Panel that shows the script.

    Signals
    -------
    copy_requested
    save_requested
    """

    copy_requested = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._text = QPlainTextEdit(readOnly=True)
        self._text.setUndoRedoEnabled(False)
        self._text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._text.setAccessibleName(tr("Script"))
        copy = QPushButton(icon("content-copy"), tr("Copy"))
        set_help(copy, tr("Copy the script"), tr("Copy the whole script to the clipboard."))
        copy.clicked.connect(self.copy_requested)
        save = QPushButton(icon("content-save-outline"), tr("Save as…"))
        set_help(save, tr("Save the script"), tr("Save the script as a Python file: python FILE repeats the changes."))
        save.clicked.connect(self.save_requested)
        head = fill(
            QHBoxLayout(),
            (note(tr("Python script that makes the mesh shown again; the view is at its end.")), 1),
            copy,
            save,
        )
        fill(QVBoxLayout(self), head, (self._text, 1), margins=(8, 8, 8, 8))

    def show_text(self, text: str) -> None:
        """Show a script, where the user has scrolled to; a selection stays while the script does."""
        if text != self._text.toPlainText():
            bars = self._text.verticalScrollBar(), self._text.horizontalScrollBar()
            places = [bar.value() for bar in bars]
            self._text.setPlainText(text)
            for bar, place in zip(bars, places, strict=True):
                bar.setValue(place)
