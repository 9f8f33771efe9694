"""The rows of tabs that Qt makes for docks."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QTabBar, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock

#: Names of the rows of tabs, for screen readers.
_NAMES = {PanelPlace.TOOLS: "Tools", PanelPlace.FACTS: "Figures", PanelPlace.DRAWER: "Panels below the view"}


class TabBars:
    """Sets up rows of tabs, which Qt makes, empties and reuses as docks move.

    Parameters
    ----------
    main : QMainWindow
    close_drawer : callable
        Called on a double click on a tab of the drawer.
    """

    def __init__(self, main: QMainWindow, close_drawer: Callable[[], object]):
        self._main, self._close_drawer = main, close_drawer

    def _all(self) -> list[QTabBar]:
        return self._main.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)

    def set_up(self, docks: Iterable[Dock]) -> None:
        """Name the rows, and let Tab reach those that have tabs right before their pages."""
        by_title = {dock.windowTitle(): dock for dock in docks}
        for bar in self._all():
            bar.setFocusPolicy(Qt.FocusPolicy.TabFocus if bar.count() else Qt.FocusPolicy.NoFocus)
            first = next((by_title[title] for title in map(bar.tabText, range(bar.count())) if title in by_title), None)
            if first is None or bar.accessibleName() == _NAMES[first.place]:
                continue
            if not bar.accessibleName():
                bar.setElideMode(Qt.TextElideMode.ElideNone)
                bar.setUsesScrollButtons(True)
                bar.setDrawBase(False)
                bar.tabBarDoubleClicked.connect(lambda _, bar=bar: self._on_double_click(bar))
            bar.setAccessibleName(_NAMES[first.place])
            before = first.previousInFocusChain()
            while not before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # Qt puts nothing after any other
                before = before.previousInFocusChain()
            if before is not bar:
                QWidget.setTabOrder(before, bar)

    def drawer_height(self) -> int:
        """Height of the drawer's row of tabs in pixels, 0 without one."""
        return sum(bar.height() for bar in self._all() if _is_drawer(bar) and bar.isVisible())

    def _on_double_click(self, bar: QTabBar) -> None:
        if _is_drawer(bar):
            self._close_drawer()


def _is_drawer(bar: QTabBar) -> bool:
    return bar.accessibleName() == _NAMES[PanelPlace.DRAWER]
