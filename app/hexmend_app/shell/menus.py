"""Menus, tool bar and shortcuts, built from the actions of features."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu, QToolBar

from hexmend_app.feature import MENUS, Action, ButtonAppearance
from hexmend_app.theme.style import icon
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import HoldButton


class Menus:
    """Menus and tool bar of the window.

    Parameters
    ----------
    window : QMainWindow
    actions : sequence of Action
        Sorted by feature.

    Attributes
    ----------
    actions : dict of QAction
        By id, sorted by menu.
    """

    def __init__(self, window: QMainWindow, actions: Sequence[Action]):
        self._window = window
        self._declared: dict[str, Action] = {}
        self.actions: dict[str, QAction] = {}
        self._bar = QToolBar(tr("Tools"))
        self._bar.setObjectName("toolbar")
        self._bar.setIconSize(QSize(16, 16))
        self._menus = _menus(window)
        for path in ("", *MENUS):
            self._fill(path, [action for action in actions if action.menu == path])
        for name, menu in self._menus.items():
            menu.menuAction().setVisible(not menu.isEmpty())
            if "/" in name and menu.isEmpty():
                menu.deleteLater()
        if self._bar.actions() and self._bar.actions()[-1].isSeparator():
            self._bar.removeAction(self._bar.actions()[-1])
        self._bar.setMinimumWidth(self._bar.sizeHint().width())  # otherwise Qt hides buttons that fit
        self._window.menuBar().setCornerWidget(self._bar, Qt.Corner.TopRightCorner)

    def _fill(self, name: str, actions: list[Action]) -> None:
        group = QActionGroup(self._window) if any(declared.exclusive for declared in actions) else None
        section = None
        for declared in sorted(actions, key=lambda declared: declared.section):
            action = self._make(declared)
            if name:
                menu = self._menus[name]
                if section is not None and section != declared.section:
                    menu.addSeparator()
                menu.addAction(action)
                if declared.submenu is not None:
                    menu.addMenu(declared.submenu)
            else:
                self._window.addAction(action)
            section = declared.section
            if declared.exclusive:
                group.addAction(action)
            if declared.momentary:
                self._bar.addWidget(HoldButton(action))
            elif declared.tool:
                self._bar.addAction(action)
        if self._bar.actions() and not self._bar.actions()[-1].isSeparator():
            self._bar.addSeparator()

    def _make(self, declared: Action) -> QAction:
        if declared.id in self._declared:
            raise ValueError(f"two features declare an action {declared.id!r}")
        action = QAction(declared.text, self._window)
        action.setShortcut(QKeySequence(declared.keys))
        action.setProperty("name", declared.text.replace("&", "").rstrip("…"))
        _show_appearance(action, ButtonAppearance(declared.tool, declared.icon, declared.help))
        action.setProperty("within", tr(declared.menu.rpartition("/")[2]) if "/" in declared.menu else "")
        action.setCheckable(declared.checked is not None)
        handle = declared.handle
        if declared.checked is not None:
            action.triggered.connect(handle)  # `refresh` would emit `toggled` too
        else:
            action.triggered.connect(lambda checked=False: handle())
        self._declared[declared.id] = declared
        self.actions[declared.id] = action
        return action

    def refresh(self, is_open: bool) -> None:
        """Update enabled state, checked state and text of every action.

        Parameters
        ----------
        is_open : bool
            A mesh is open.
        """
        for id, declared in self._declared.items():
            action = self.actions[id]
            action.setEnabled((is_open or not declared.needs_mesh) and declared.enabled())
            if declared.checked is not None:
                action.setChecked(declared.checked())
            if declared.appearance is not None:
                appearance = declared.appearance()
                action.setProperty("name", appearance.text)
                _show_appearance(action, appearance)
            if declared.title is not None:
                action.setText(declared.title())
                action.setIconText(declared.tool or declared.text.replace("&", ""))

    def declared(self) -> Iterable[Action]:
        """Return the declarations of all actions."""
        return self._declared.values()

    def context_menu(self) -> QMenu:
        """Return a new context menu of the view, with the actions that are enabled now."""
        menu = QMenu(self._window)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        previous = None
        # Actions for the clicked hex are listed first.
        for id, declared in sorted(self._declared.items(), key=lambda entry: entry[1].menu != "Hex"):
            if declared.in_view and self.actions[id].isEnabled():
                if previous not in (None, declared.menu):
                    menu.addSeparator()
                menu.addAction(self.actions[id])
                previous = declared.menu
        return menu


def _show_appearance(action: QAction, appearance: ButtonAppearance) -> None:
    """Set the text, icon and help that buttons of an action show; with an empty text they show the text of the menu."""
    if action.property("appearance") == list(appearance):
        return
    action.setProperty("appearance", list(appearance))
    if appearance.icon:
        action.setProperty("icon_name", appearance.icon)
        action.setIcon(icon(appearance.icon))
    if appearance.text:
        action.setIconText(appearance.text)
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.PortableText)
    action.setToolTip(f"<qt>{appearance.help}{f' ({keys})' if keys else ''}</qt>")
    action.setStatusTip(appearance.help)


def _menus(window: QMainWindow) -> dict[str, QMenu]:
    """Add the menus and submenus of `MENUS` to the menu bar; return them by name."""
    menus: dict[str, QMenu] = {}
    for name in MENUS:
        parent, _, title = name.rpartition("/")
        menus[name] = (menus[parent] if parent else window.menuBar()).addMenu(tr(title))
    return menus
