"""Panel of the script, with buttons to copy and save it."""

from __future__ import annotations

from itertools import takewhile

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase, QTextCursor
from PySide6.QtWidgets import QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend_app.features.script.view_lines import VIEW
from hexmend_app.theme.spacing import on_grid
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.translation import tr

_HELP = "Python script that repeats your actions and the current view bit for bit."


class ScriptPanel(QWidget):
    """Panel that shows the script.

    Signals
    -------
    restart_requested
    copy_requested
    save_requested
    """

    restart_requested = Signal()
    copy_requested = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._shown, self._scrolled_to = "", 0
        self._text = QPlainTextEdit(readOnly=True)
        self._text.setUndoRedoEnabled(False)
        self._text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._text.setAccessibleName(tr("Script"))
        restart = QPushButton(icon("restart"), tr("Restart"))
        set_help(restart, tr("Restart the script"), tr("Clear the script; it continues from the current mesh."))
        restart.clicked.connect(self.restart_requested)
        copy = QPushButton(icon("content-copy"), tr("Copy"))
        set_help(copy, tr("Copy the script"), tr("Copy the whole script to the clipboard."))
        copy.clicked.connect(self.copy_requested)
        save = QPushButton(icon("content-save-outline"), tr("Save as…"))
        set_help(save, tr("Save the script"), tr("Save the script as a Python file: python FILE repeats the actions."))
        save.clicked.connect(self.save_requested)
        head = on_grid(QHBoxLayout())
        head.addWidget(note(tr(_HELP)), 1)
        head.addWidget(restart)
        head.addWidget(copy)
        head.addWidget(save)
        column = on_grid(QVBoxLayout(self))
        column.setContentsMargins(8, 8, 8, 8)
        column.addLayout(head)
        column.addWidget(self._text, 1)

    def show_text(self, text: str) -> None:
        """Show a script; scroll to its newest entry unless the user has scrolled elsewhere.

        A selection in unchanged text is preserved.
        """
        vertical, horizontal = self._text.verticalScrollBar(), self._text.horizontalScrollBar()
        top, left = vertical.value(), horizontal.value()
        follows = top in (self._scrolled_to, vertical.maximum())
        same = _common_length(text, self._shown)
        cursor = QTextCursor(self._text.document())
        cursor.setPosition(self._text.document().characterCount() - 1 - _units(self._shown[same:]))
        cursor.movePosition(QTextCursor.MoveOperation.End, QTextCursor.MoveMode.KeepAnchor)
        cursor.insertText(text[same:])
        self._shown = text
        if follows:
            rows = self._text.viewport().height() // self._text.fontMetrics().lineSpacing()
            view_line = text.count("\n", 0, text.rfind(VIEW))
            self._scrolled_to = top = max(0, min(view_line - rows // 3, vertical.maximum()))
        vertical.setValue(top)
        horizontal.setValue(left)


def _common_length(text: str, other: str) -> int:
    """Return the length of the common prefix of two texts, in whole lines."""
    lines = zip(text.splitlines(keepends=True), other.splitlines(keepends=True), strict=False)
    return sum(len(line) for line, _ in takewhile(lambda both: both[0] == both[1], lines))


def _units(text: str) -> int:
    """Return the length of a text in UTF-16 units, in which Qt counts."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2
