"""What the window is busy with, and the way out of it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QPushButton, QWidget

from hexmend_app.widgets.style import explain


class Busy(QWidget):
    """A line for the status bar: what is being done, that it goes on, and a button that ends it."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._text = QLabel()
        self._text.setAccessibleName("Busy with")
        bar = QProgressBar()
        bar.setRange(0, 0)
        bar.setFixedSize(140, 10)  # no higher than text, or the view jumps as it comes and goes
        bar.setTextVisible(False)
        self._cancel = QPushButton()
        self._cancel.setFixedHeight(self._text.fontMetrics().height() + 4)
        self._cancel.clicked.connect(lambda: self._end())
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, lambda: self._end())
        self._end: Callable[[], object] = self.done
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for part in (self._text, bar, self._cancel):
            layout.addWidget(part)
        self.done()

    def show_work(self, text: str, word: str = "", help: str = "", end: Callable[[], object] | None = None) -> None:
        """Say what is being done; `word` on the button that calls `end`, with its `help`, or no button."""
        self._end = end or self.done
        self._text.setText(text)
        self._cancel.setText(word)
        explain(self._cancel, word, help)
        self._cancel.setVisible(bool(word))
        self.show()

    def text(self) -> str:
        """What is being done."""
        return self._text.text()

    def done(self) -> None:
        """Nothing is being done any more."""
        self._escape.setEnabled(False)
        self.hide()

    def take_escape(self, on: bool) -> None:
        """Let Esc end it, or leave Esc to others."""
        self._escape.setEnabled(on and not self.isHidden())
