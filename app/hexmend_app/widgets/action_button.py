"""Buttons of actions."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QToolButton

from hexmend_app.theme.palette import TEXT, Role
from hexmend_app.theme.style import icon


class ActionButton(QToolButton):
    """Tool button that shows and triggers an action of the window.

    The window shows the action on its buttons once all actions exist.

    Parameters
    ----------
    action_id : str
    icon_name : str
        Name of the icon; "" for that of the action.
    role : Role
        Colour of the icon.
    with_text : bool
        Show the text next to the icon.
    """

    def __init__(self, action_id: str, icon_name: str = "", role: Role = TEXT, with_text: bool = False):
        super().__init__()
        self.action_id, self._icon_name, self._role = action_id, icon_name, role
        style = Qt.ToolButtonStyle
        self.setToolButtonStyle(style.ToolButtonTextBesideIcon if with_text else style.ToolButtonIconOnly)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setEnabled(False)  # until it shows an action

    def reserve_width(self, texts: Iterable[str], around: int) -> None:
        """Reserve the width of the longest of some texts, so that nothing moves when the text changes.

        Parameters
        ----------
        texts : iterable of str
        around : int
            Pixels around icon and text.
        """
        self.ensurePolished()
        widest = max(map(self.fontMetrics().horizontalAdvance, texts))
        self.setMinimumWidth(widest + self.iconSize().width() + around)

    def show_action(self, action: QAction) -> None:
        """Show an action, which the button triggers when pressed."""
        self.setDefaultAction(action)
        action.changed.connect(self._show_names_and_icon)  # emitted after Qt has updated the button
        self._show_names_and_icon()

    def _show_names_and_icon(self) -> None:
        """Show what Qt does not take from the action: accessible texts, and an icon of another name or colour."""
        action = self.defaultAction()
        self.setAccessibleName(action.property("name") or action.iconText())
        self.setAccessibleDescription(action.statusTip())
        self.setStatusTip("")  # it has a tooltip, and the row of panels is in the status bar
        if self._icon_name or self._role is not TEXT:
            self.setIcon(icon(self._icon_name or action.property("icon_name"), self._role))


class HoldButton(QToolButton):
    """Tool button that keeps a checkable action checked while it is pressed, and looks pressed while that is checked.

    Parameters
    ----------
    action : QAction
    """

    def __init__(self, action: QAction):
        super().__init__()
        self._action = action
        self.setAutoRaise(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # as the other buttons of a tool bar
        self.pressed.connect(lambda: self._set(True))
        self.released.connect(lambda: self._set(False))
        action.changed.connect(self._show_action)
        self._show_action()

    def _set(self, on: bool) -> None:
        if self._action.isChecked() is not on:
            self._action.trigger()

    def _show_action(self) -> None:
        action = self._action
        self.setEnabled(action.isEnabled())
        self.setDown(action.isChecked())
        self.setIcon(action.icon())
        self.setText(action.iconText())
        self.setToolTip(action.toolTip())
        self.setAccessibleName(action.property("name"))
        self.setAccessibleDescription(action.statusTip())
