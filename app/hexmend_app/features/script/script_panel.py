"""Panel of the script, with buttons to copy and save it."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.translation import tr


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
