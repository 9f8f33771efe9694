"""The script as it grows, with what copies and saves it."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QHBoxLayout, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend_app.widgets.style import BLUE, LINE, dress, explain, icon, note

_WORDS = "What is done here as Python that does it again, to the bit."


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
        self._text = QPlainTextEdit(readOnly=True)
        self._text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._text.setAccessibleName("Script")
        dress(self._text, lambda: self._text.setStyleSheet(_sheet()))
        anew = QPushButton(icon("restart"), "Begin anew")
        explain(
            anew,
            "Begin the script anew",
            "Forget what was done so far: what comes next goes on from the mesh as it is.",
        )
        anew.clicked.connect(self.anew_requested)
        copy = QPushButton(icon("content-copy"), "Copy")
        explain(copy, "Copy the script", "Copy all of it.")
        copy.clicked.connect(self.copy_requested)
        save = QPushButton(icon("content-save-outline"), "Save as…")
        explain(save, "Save the script", "Save it as a Python file: python FILE does it again.")
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
        """Show this, and its end unless somebody reads further up."""
        bar, aside = self._text.verticalScrollBar(), self._text.horizontalScrollBar()
        at, across = bar.value(), aside.value()
        at_the_end = at >= bar.maximum()
        self._text.setPlainText(text)
        bar.setValue(bar.maximum() if at_the_end else at)
        aside.setValue(across)


def _sheet() -> str:
    """A frame that tells where the keyboard is."""
    return f"QPlainTextEdit {{ border: 1px solid {LINE}; }} QPlainTextEdit:focus {{ border-color: {BLUE}; }}"
