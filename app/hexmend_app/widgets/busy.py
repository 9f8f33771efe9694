"""Progress indicator of tasks in the background, with a button to cancel."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QPushButton, QSizePolicy, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel

#: Steps of the bar.
_STEPS = 1000


class Busy(QWidget):
    """Progress indicator of the newest task, with a button that ends it."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._text = ElidingLabel()
        self._text.setAccessibleName(tr("Current task"))
        self._bar = QProgressBar()
        self._bar.setRange(0, 0)
        self._bar.setFixedSize(140, 10)  # as high as text, so that the layout does not jump
        self._bar.setTextVisible(False)
        self._bar.setAccessibleName(tr("Progress of the task"))
        self._cancel = QPushButton()
        self._cancel.setFixedHeight(self._text.fontMetrics().height() + 4)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Ignored)  # the status bar keeps its height
        self._cancel.clicked.connect(lambda: self._end())
        self._escape_owner = ""
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, lambda: self._end(self._escape_owner))
        self._tasks: dict[str, tuple[str, str, str, Callable[[], object], float | None]] = {}  # by owner
        fill(QHBoxLayout(self), self._text, self._bar, self._cancel, margins=(8, 0, 8, 0))
        self.hide()

    def show_work(
        self,
        owner: str,
        text: str,
        button_text: str = "",
        help: str = "",
        cancel: Callable[[], object] | None = None,
        share: float | None = None,
    ) -> None:
        """Show the task of an owner, with a button that calls `cancel`; without a button if its text is "".

        `share` is what is done, 0 to 1; None if it is unknown.
        """
        self._tasks[owner] = text, button_text, help, cancel or (lambda: self.done(owner)), share
        self._show()

    @property
    def share(self) -> float | None:
        """Share of the task that the bar shows, 0 to 1; None if it is unknown."""
        return self._bar.value() / self._bar.maximum() if self._bar.maximum() else None

    def text(self) -> str:
        """Return the text shown."""
        return self._text.text()

    def done(self, owner: str) -> None:
        """Remove the task of an owner."""
        if self._tasks.pop(owner, None) is not None:
            self._show()

    def _end(self, owner: str = "") -> None:
        """End the task of an owner, or the newest task if it has none."""
        if self._tasks:
            self._tasks.get(owner, list(self._tasks.values())[-1])[3]()

    def _show(self) -> None:
        if not self._tasks:
            self._escape.setEnabled(False)
            self.hide()
            return
        text, button_text, help, _, share = list(self._tasks.values())[-1]
        self._text.setText(text)
        self._bar.setRange(0, 0 if share is None else _STEPS)
        self._bar.setValue(0 if share is None else round(share * _STEPS))
        self._cancel.setText(button_text)
        set_help(self._cancel, button_text, help)
        self._cancel.setVisible(bool(button_text))
        self.show()

    def take_escape(self, owner: str) -> None:
        """Let Esc end the task of an owner; "" disables Esc."""
        self._escape_owner = owner
        self._escape.setEnabled(owner in self._tasks)
