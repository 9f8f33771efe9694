"""Small button that opens a menu."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from hexmend_app.theme.palette import BUTTON, HOVER
from hexmend_app.theme.style import BLUE, LINE, on_theme_change, set_help


class MenuButton(QToolButton):
    """Button that opens `menu()`, which is empty at first.

    Parameters
    ----------
    name, help : str
        See `hexmend_app.theme.style.set_help`.
    """

    def __init__(self, name: str, help: str, parent: QWidget | None = None):
        super().__init__(parent)
        menu = QMenu(self)
        menu.setToolTipsVisible(True)
        self.setMenu(menu)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        on_theme_change(self, lambda: self.setStyleSheet(_sheet()))
        set_help(self, name, help)


def _sheet() -> str:
    """Return the style sheet of the button, without the arrow of menu buttons."""
    return f"""
QToolButton {{ background: {BUTTON}; border: 1px solid {LINE}; border-radius: 3px; padding: 3px; }}
QToolButton:hover {{ background: {HOVER}; }}
QToolButton:focus {{ border-color: {BLUE}; }}
QToolButton::menu-indicator {{ image: none; }}
"""
