"""Menus and tool bar, built from the actions as data."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu, QToolBar

from hexmend_app.shell.actions import ACTIONS, ActionSpec
from hexmend_app.widgets.style import icon


def build_menus(window: QMainWindow, handlers: dict[str, Callable], above: dict[str, QMenu]) -> dict[str, QAction]:
    """Give a window its menus and tool bar.

    Parameters
    ----------
    window : QMainWindow
    handlers : dict
        What each action calls, by its id; that of a checkable action takes whether it is on.
    above : dict
        Menus that stand above an action in its menu, by its id.

    Returns
    -------
    dict
        Actions by id.
    """
    bar = QToolBar("Tools")
    bar.setObjectName("toolbar")
    bar.setMovable(False)
    bar.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    window.addToolBar(bar)
    actions: dict[str, QAction] = {}
    menus: dict[str, QMenu] = {}
    groups: dict[str, QActionGroup] = {}
    for spec in ACTIONS:
        if spec.menu not in menus:
            within, _, name = spec.menu.rpartition("/")
            menus[spec.menu] = (menus[within] if within else window.menuBar()).addMenu(name)
            if bar.actions() and not bar.actions()[-1].isSeparator():
                bar.addSeparator()
        action = actions[spec.id] = _action(window, spec)
        handle = handlers[spec.id]
        if spec.checkable:
            action.toggled.connect(handle)
        else:
            action.triggered.connect(lambda checked=False, handle=handle: handle())
        if spec.exclusive:
            groups.setdefault(spec.menu, QActionGroup(window)).addAction(action)
            action.setProperty("within", menus[spec.menu].title().replace("&", ""))
        if spec.separated:
            menus[spec.menu].addSeparator()
        if spec.id in above:
            menus[spec.menu].addMenu(above[spec.id])
        menus[spec.menu].addAction(action)
        if spec.tool:
            bar.addAction(action)
    return actions


def _action(window: QMainWindow, spec: ActionSpec) -> QAction:
    action = QAction(spec.text, window)
    if spec.icon:
        action.setIcon(icon(spec.icon))
    if spec.tool:
        action.setIconText(spec.tool)
    keys = f" ({spec.shortcut})" if spec.shortcut else ""
    action.setShortcut(QKeySequence(spec.shortcut))
    action.setToolTip(f"<qt>{spec.help}{keys}</qt>")
    action.setStatusTip(spec.help)
    action.setCheckable(spec.checkable)
    return action
