"""Buttons that show an action."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QToolButton, QWidget

from hexmend_app.theme.palette import TEXT, Role
from hexmend_app.theme.style import icon


class ActionButton(QToolButton):
    """Tool button that shows an action of the window: icon, text, tooltip with the keys, and whether it is enabled.

    Parameters
    ----------
    icon_name : str
        Name of the icon; by default that of the action.
    role : Role
        Colour of the icon.
    with_text : bool
        The text is shown next to the icon.
    """

    def __init__(self, icon_name: str = "", role: Role = TEXT, with_text: bool = False, parent: QWidget | None = None):
        super().__init__(parent)
        self._icon_name, self._role = icon_name, role
        style = Qt.ToolButtonStyle
        self.setToolButtonStyle(style.ToolButtonTextBesideIcon if with_text else style.ToolButtonIconOnly)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setEnabled(False)  # until it shows an action

    def show_action(self, action: QAction) -> None:
        """Show an action, and trigger it when pressed."""
        self.setDefaultAction(action)
        action.changed.connect(self._show_rest)  # emitted after the button has taken over what Qt's buttons show
        self._show_rest()

    def _show_rest(self) -> None:
        action = self.defaultAction()
        self.setAccessibleName(action.property("name") or action.iconText())
        self.setAccessibleDescription(action.statusTip())
        self.setStatusTip("")  # it has a tooltip, and the row of panels is in the status bar
        if self._icon_name or self._role is not TEXT:
            self.setIcon(icon(self._icon_name or action.property("icon_name"), self._role))
