"""What the window is busy with, and the way out of it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QPushButton, QWidget

from hexmend_app.widgets.style import explain


class Busy(QWidget):
    """A line that says what is being done, that it goes on, with a button that ends it; of several, the newest."""

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
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, lambda: self._end(self._escaping))
        self._escaping = ""
        self._works: dict[str, tuple[str, str, str, Callable[[], object]]] = {}  # by who does them
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for part in (self._text, bar, self._cancel):
            layout.addWidget(part)
        self.hide()

    def show_work(
        self, who: str, text: str, word: str = "", help: str = "", end: Callable[[], object] | None = None
    ) -> None:
        """Say what somebody does; `word` on the button that calls `end`, with its `help`, or no button."""
        self._works[who] = text, word, help, end or (lambda: self.done(who))
        self._show()

    def text(self) -> str:
        """What is being done."""
        return self._text.text()

    def done(self, who: str) -> None:
        """Somebody does nothing any more."""
        if self._works.pop(who, None) is not None:
            self._show()

    def _end(self, who: str = "") -> None:
        """End what somebody does, or the newest."""
        if self._works:
            self._works.get(who, list(self._works.values())[-1])[3]()

    def _show(self) -> None:
        if not self._works:
            self._escape.setEnabled(False)
            self.hide()
            return
        text, word, help, _ = list(self._works.values())[-1]
        self._text.setText(text)
        self._cancel.setText(word)
        explain(self._cancel, word, help)
        self._cancel.setVisible(bool(word))
        self.show()

    def take_escape(self, who: str) -> None:
        """Let Esc end what somebody does, or, for "", leave Esc to others."""
        self._escaping = who
        self._escape.setEnabled(who in self._works)
