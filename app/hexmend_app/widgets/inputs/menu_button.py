"""Small button that opens a menu."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from hexmend_app.theme.style import set_help


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
        set_help(self, name, help)

    def add(self, text: str, help: str, checked: bool | None = None) -> QAction:
        """Add an action to the menu; one that can be checked unless `checked` is None."""
        action = self.menu().addAction(text)
        action.setCheckable(checked is not None)
        action.setChecked(bool(checked))
        action.setToolTip(f"<qt>{help}</qt>")
        action.setWhatsThis(help)
        return action
