"""Panel of the script, with buttons to copy and save it."""

from __future__ import annotations

from itertools import takewhile

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase, QTextCursor
from PySide6.QtWidgets import QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend_app.features.script.seen import SEEN
from hexmend_app.theme.style import BLUE, LINE, icon, note, on_theme_change, set_help

_WORDS = "Your actions as a Python script that repeats them bit for bit, and the current view."


class ScriptPanel(QWidget):
    """Shows a script.

    Signals
    -------
    anew_requested
    copy_requested
    save_requested
    """

    anew_requested = Signal()
    copy_requested = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._shown, self._at = "", 0
        self._text = QPlainTextEdit(readOnly=True)
        self._text.setUndoRedoEnabled(False)
        self._text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._text.setAccessibleName("Script")
        on_theme_change(self._text, lambda: self._text.setStyleSheet(_sheet()))
        anew = QPushButton(icon("restart"), "Restart")
        set_help(
            anew,
            "Restart the script",
            "Clear the script; it continues from the current mesh.",
        )
        anew.clicked.connect(self.anew_requested)
        copy = QPushButton(icon("content-copy"), "Copy")
        set_help(copy, "Copy the script", "Copy the whole script to the clipboard.")
        copy.clicked.connect(self.copy_requested)
        save = QPushButton(icon("content-save-outline"), "Save as…")
        set_help(save, "Save the script", "Save the script as a Python file: python FILE repeats the actions.")
        save.clicked.connect(self.save_requested)
        head = QHBoxLayout()
        head.addWidget(note(_WORDS), 1)
        head.addWidget(anew)
        head.addWidget(copy)
        head.addWidget(save)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.addLayout(head)
        column.addWidget(self._text, 1)

    def show_text(self, text: str) -> None:
        """Show this, with the newest entry and what is seen in sight unless somebody reads elsewhere.

        What stays as it was stays selected too.
        """
        bar, aside = self._text.verticalScrollBar(), self._text.horizontalScrollBar()
        at, across = bar.value(), aside.value()
        follows = at in (self._at, bar.maximum())
        same = _alike(text, self._shown)
        place = self._text.document().characterCount() - 1 - _units(self._shown[same:])
        cursor = QTextCursor(self._text.document())
        cursor.setPosition(place)
        cursor.movePosition(QTextCursor.MoveOperation.End, QTextCursor.MoveMode.KeepAnchor)
        cursor.insertText(text[same:])
        self._shown = text
        if follows:
            rows = self._text.viewport().height() // self._text.fontMetrics().lineSpacing()
            self._at = at = max(0, min(text.count("\n", 0, text.rfind(SEEN)) - rows // 3, bar.maximum()))
        bar.setValue(at)
        aside.setValue(across)


def _alike(one: str, other: str) -> int:
    """Return the length of the common prefix of two texts, in whole lines."""
    lines = zip(one.splitlines(keepends=True), other.splitlines(keepends=True), strict=False)
    return sum(len(line) for line, _ in takewhile(lambda both: both[0] == both[1], lines))


def _units(text: str) -> int:
    """Return the length of a text in UTF-16 units, in which Qt counts."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def _sheet() -> str:
    """Return a style sheet with a frame that shows the keyboard focus."""
    return f"QPlainTextEdit {{ border: 1px solid {LINE}; }} QPlainTextEdit:focus {{ border-color: {BLUE}; }}"
