"""Progress of work in the background, with a button to cancel it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QPushButton, QWidget

from hexmend_app.theme.style import set_help


class Busy(QWidget):
    """Shows the newest work in progress, with a button that ends it."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._text = QLabel()
        self._text.setAccessibleName("Busy with")
        bar = QProgressBar()
        bar.setRange(0, 0)
        bar.setFixedSize(140, 10)  # as high as text, so that the layout does not jump
        bar.setTextVisible(False)
        self._cancel = QPushButton()
        self._cancel.setFixedHeight(self._text.fontMetrics().height() + 4)
        self._cancel.clicked.connect(lambda: self._end())
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, lambda: self._end(self._escaping))
        self._escaping = ""
        self._works: dict[str, tuple[str, str, str, Callable[[], object]]] = {}  # by owner
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for part in (self._text, bar, self._cancel):
            layout.addWidget(part)
        self.hide()

    def show_work(
        self, source: str, text: str, word: str = "", help: str = "", end: Callable[[], object] | None = None
    ) -> None:
        """Show the work of an owner, with a button `word` that calls `end`, or without a button."""
        self._works[source] = text, word, help, end or (lambda: self.done(source))
        self._show()

    def text(self) -> str:
        """The text shown."""
        return self._text.text()

    def done(self, owner: str) -> None:
        """Remove the work of an owner."""
        if self._works.pop(owner, None) is not None:
            self._show()

    def _end(self, owner: str = "") -> None:
        """End the work of an owner, or the newest."""
        if self._works:
            self._works.get(owner, list(self._works.values())[-1])[3]()

    def _show(self) -> None:
        if not self._works:
            self._escape.setEnabled(False)
            self.hide()
            return
        text, word, help, _ = list(self._works.values())[-1]
        self._text.setText(text)
        self._cancel.setText(word)
        set_help(self._cancel, word, help)
        self._cancel.setVisible(bool(word))
        self.show()

    def take_escape(self, owner: str) -> None:
        """Let Esc end the work of an owner; with "", Esc is not used."""
        self._escaping = owner
        self._escape.setEnabled(owner in self._works)
