"""The script of the open mesh and a Python console, in one panel."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QApplication, QHBoxLayout, QPlainTextEdit, QSplitter, QVBoxLayout, QWidget

from hexmend.report.documents import write_text
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.reproduce.console import ConsolePanel
from hexmend_app.features.reproduce.script import script_of
from hexmend_app.picture import Page, Scene
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import push_button, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_save


class FeatureReproduce(Feature):
    """Shows what made the mesh as a Python script, copies and saves it, and runs Python commands."""

    def __init__(self, host: Host):
        super().__init__(host)
        self.panel = ReproducePanel(ConsolePanel(self.session))
        self.panel.copy_button.clicked.connect(self.copy)
        self.panel.save_button.clicked.connect(self.ask)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that open the panel and save the script."""
        yield Action(
            id="reproduce",
            text=tr("Python conso&le"),
            menu="Edit",
            keys="Ctrl+`",
            icon="console",
            help=tr("Open the Python script of the mesh, and a console that uses and changes the mesh."),
            handle=self.show,
            needs_mesh=False,
        )
        yield Action(
            id="script",
            text=tr("Save scr&ipt…"),
            menu="File",
            section=1,
            icon="script-text-outline",
            help=tr("Save the changes of the mesh as a Python script."),
            handle=self.ask,
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel."""
        yield Panel(
            id="reproduce",
            title=tr("Reproduce"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=70,
            help=tr("The changes of the mesh as a Python script, and a Python console."),
        )

    def refresh(self) -> None:
        """Show the script if the panel is visible, unless a run is active."""
        if self.panel.isVisible() and self.session.run.phase is not Phase.RUNNING:
            self.panel.show_text(self.text)

    def show(self) -> None:
        """Open the panel and focus the line of the console."""
        self.host.show_panel("reproduce")
        self.panel.console.line.setFocus()

    @property
    def text(self) -> str:
        """The script, with the scene of the view at its end."""
        return script_of(self.session, self._scene())

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
        name = f"{self.host.default_file_stem}.py"
        if path := ask_to_save(self.host.dialog_parent, tr("Save script as"), name, tr("Python script (*.py)")):
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the script; return True if it was written."""
        return self.write_file(tr("Script"), path, lambda at: write_text(at, self.text))

    def close(self) -> None:
        """Drop the command that runs."""
        self.panel.console.close_task()


class ReproducePanel(QWidget):
    """The script with its buttons, and the console beside it."""

    def __init__(self, console: ConsolePanel, parent: QWidget | None = None):
        super().__init__(parent)
        self.console = console
        self._text = QPlainTextEdit(readOnly=True)
        self._text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._text.setAccessibleName(tr("Script"))
        help = tr("Copy the whole script to the clipboard.")
        self.copy_button = push_button(tr("Copy"), help, "content-copy", name=tr("Copy the script"))
        help = tr("Save the script as a Python file: python FILE repeats the changes.")
        self.save_button = push_button(tr("Save as…"), help, "content-save-outline", name=tr("Save the script"))
        purpose = small_label(tr("Python script that makes the mesh shown again; the view is at its end."))
        script = QWidget()
        head = fill(QHBoxLayout(), (purpose, 1), self.copy_button, self.save_button)
        fill(QVBoxLayout(script), head, (self._text, 1), margins=(0, 0, 0, 0))
        both = QSplitter(childrenCollapsible=False)
        both.addWidget(script)
        both.addWidget(console)
        fill(QVBoxLayout(self), both, margins=(8, 8, 8, 8))

    def show_text(self, text: str) -> None:
        """Show a script, where the user has scrolled to; a selection stays while the script does."""
        if text != self._text.toPlainText():
            bars = self._text.verticalScrollBar(), self._text.horizontalScrollBar()
            places = [bar.value() for bar in bars]
            self._text.setPlainText(text)
            for bar, place in zip(bars, places, strict=True):
                bar.setValue(place)
