"""How the view is driven, said on the first start and whenever it is asked for."""

from __future__ import annotations

from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QToolButton, QWidget

from hexmend_app.state.theme import TEXT, TOLD
from hexmend_app.widgets.style import dress, explain, icon

_DISMISSED = "hint dismissed"
_KEYS = (
    ("Turn", "drag, or arrow keys"),
    ("Zoom", "wheel, or + and −"),
    ("Pan", "Shift and drag, middle button, or Shift and arrows"),
    ("Element", "click"),
    ("Next worst", "N"),
    ("Smooth", "F5"),
    ("Every command", "Ctrl+Shift+P"),
)


class Hint(QFrame):
    """A line beside the view that stays away once it has been dismissed."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("hint")
        # What belongs together is not torn apart at the end of a line.
        parts = (f"<b>{what}:</b> {how}".replace(" ", "&nbsp;") for what, how in _KEYS)
        text = QLabel(" &nbsp;&nbsp; ".join(parts))
        text.setTextFormat(Qt.TextFormat.RichText)
        text.setWordWrap(True)
        text.setAccessibleName("Mouse and keys")
        self._close = QToolButton()
        self._close.setIcon(icon("close"))
        self._close.setAutoRaise(True)
        self._close.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._close.clicked.connect(self.dismiss)
        explain(self._close, "Dismiss the hint", "Do not show this again; F1 does.")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 5, 6, 5)
        layout.addWidget(text, 1)
        layout.addWidget(self._close, 0, Qt.AlignmentFlag.AlignTop)
        dress(self, lambda: self.setStyleSheet(f"#hint {{ background: {TOLD}; }} #hint QLabel {{ color: {TEXT}; }}"))
        self.setHidden(QSettings().value(_DISMISSED, "") == "yes")

    def dismiss(self) -> None:
        """Go, and stay away at later starts."""
        QSettings().setValue(_DISMISSED, "yes")
        self.hide()
