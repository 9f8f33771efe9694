"""How the view is driven, said on the first start and whenever it is asked for."""

from __future__ import annotations

from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QToolButton, QWidget

from hexmend_app.scene.palette import TEXT, TOLD
from hexmend_app.widgets.style import dress, explain, icon

_DISMISSED = "hint dismissed"
_KEYS = (
    ("Turn", "drag, arrows"),
    ("Zoom", "wheel, + −"),
    ("Pan", "middle or Shift+drag, Shift+arrows"),
    ("Element", "click"),
    ("Next worst", "N"),
    ("Run", "F5"),
    ("Commands", "Ctrl+Shift+P"),
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
        self.close_button = QToolButton()
        self.close_button.setIcon(icon("close"))
        self.close_button.setAutoRaise(True)
        self.close_button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.close_button.clicked.connect(self.dismiss)
        explain(self.close_button, "Dismiss the hint", "Do not show this again; F1 does.")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 5, 6, 5)
        layout.addWidget(text, 1)
        layout.addWidget(self.close_button, 0, Qt.AlignmentFlag.AlignTop)
        dress(self, lambda: self.setStyleSheet(f"#hint {{ background: {TOLD}; }} #hint QLabel {{ color: {TEXT}; }}"))
        self.setHidden(QSettings().value(_DISMISSED, "") == "yes")

    def dismiss(self) -> None:
        """Go, and stay away at later starts."""
        QSettings().setValue(_DISMISSED, "yes")
        self.hide()
