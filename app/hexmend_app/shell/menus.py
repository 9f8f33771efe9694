"""Menus, tool bar and shortcuts, made from the actions of features."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu, QToolBar

from hexmend_app.feature import MENUS, Action, ActionFace
from hexmend_app.shell.mnemonics import letter_of, letters, marked
from hexmend_app.theme.style import icon


class Menus:
    """The window's menus with their actions.

    Parameters
    ----------
    window : QMainWindow
    actions : sequence of Action
        In the order of their features.

    Attributes
    ----------
    actions : dict of QAction
        By id, in the order of the menus.
    """

    def __init__(self, window: QMainWindow, actions: Sequence[Action]):
        self._window = window
        self._declared: dict[str, Action] = {}
        self.actions: dict[str, QAction] = {}
        self._bar = QToolBar("Tools")
        self._bar.setObjectName("toolbar")
        self._bar.setIconSize(QSize(16, 16))
        self._menus = _menus(window)
        for menu in ("", *MENUS):
            self._fill(menu, [one for one in actions if one.menu == menu])
        for name, menu in self._menus.items():
            menu.menuAction().setVisible(not menu.isEmpty())
            if "/" in name and menu.isEmpty():
                menu.deleteLater()
        for menu in (window.menuBar(), *self._menus.values()):
            _give_letters([action for action in menu.actions() if not action.isSeparator()])
        for trailing in self._bar.actions()[-1:]:
            if trailing.isSeparator():
                self._bar.removeAction(trailing)
        self._bar.setMinimumWidth(self._bar.sizeHint().width())  # or it hides buttons that fit
        self._window.menuBar().setCornerWidget(self._bar, Qt.Corner.TopRightCorner)

    def _fill(self, name: str, actions: list[Action]) -> None:
        group = QActionGroup(self._window) if any(one.exclusive for one in actions) else None
        part = None
        for declared in sorted(actions, key=lambda one: one.part):
            action = self._make(declared)
            if name:
                menu = self._menus[name]
                if part is not None and part != declared.part:
                    menu.addSeparator()
                menu.addAction(action)
                if declared.submenu is not None:
                    menu.addMenu(declared.submenu)
            else:
                self._window.addAction(action)
            part = declared.part
            if declared.exclusive:
                group.addAction(action)
            if declared.tool:
                self._bar.addAction(action)
        if self._bar.actions() and not self._bar.actions()[-1].isSeparator():
            self._bar.addSeparator()

    def _make(self, declared: Action) -> QAction:
        if declared.id in self._declared:
            raise ValueError(f"two features declare an action {declared.id!r}")
        action = QAction(declared.text, self._window)
        action.setShortcut(QKeySequence(declared.keys))
        action.setProperty("name", declared.text.replace("&", "").rstrip("…"))
        _show_face(action, ActionFace(declared.tool, declared.icon, declared.help))
        action.setProperty("within", declared.menu.rpartition("/")[2] if "/" in declared.menu else "")
        action.setCheckable(declared.checked is not None)
        handle = declared.handle
        if declared.checked is not None:
            action.triggered.connect(handle)  # `toggled` would be sent by `refresh` too
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
            if declared.face is not None:
                face = declared.face()
                action.setProperty("name", face.text)
                _show_face(action, face)
            if declared.title is not None:
                action.setText(marked(declared.title(), letter_of(action.text())))
                action.setIconText(declared.tool or declared.text.replace("&", ""))

    def declared(self) -> Iterable[Action]:
        """The declarations of all actions."""
        return self._declared.values()

    def in_view(self) -> QMenu:
        """The context menu of the view."""
        menu = QMenu(self._window)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        before = None
        # Actions for the clicked hex come first.
        for id, declared in sorted(self._declared.items(), key=lambda one: one[1].menu != "Hex"):
            if declared.in_view and self.actions[id].isEnabled():
                if before not in (None, declared.menu):
                    menu.addSeparator()
                menu.addAction(self.actions[id])
                before = declared.menu
        return menu


def _show_face(action: QAction, face: ActionFace) -> None:
    """Show text, icon and help of an action on its buttons; without a text, they show that of the menu."""
    if action.property("face") == list(face):
        return
    action.setProperty("face", list(face))
    if face.icon:
        action.setProperty("icon_name", face.icon)
        action.setIcon(icon(face.icon))
    if face.text:
        action.setIconText(face.text)
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.PortableText)
    action.setToolTip(f"<qt>{face.help}{f' ({keys})' if keys else ''}</qt>")
    action.setStatusTip(face.help)


def _give_letters(actions: Sequence[QAction]) -> None:
    """Give the entries of a menu distinct mnemonics."""
    for action, letter in zip(actions, letters([action.text() for action in actions]), strict=True):
        action.setText(marked(action.text(), letter))


def _menus(window: QMainWindow) -> dict[str, QMenu]:
    menus: dict[str, QMenu] = {}
    for name in MENUS:
        within, _, title = name.rpartition("/")
        menus[name] = (menus[within] if within else window.menuBar()).addMenu(title)
    return menus
