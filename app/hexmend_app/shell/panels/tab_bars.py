"""Tab bars that Qt creates for docks."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QTabBar, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.translation import tr

#: Accessible names of the tab bars.
_NAMES = {PanelPlace.TOOLS: "Tools", PanelPlace.FACTS: "Figures", PanelPlace.DRAWER: "Panels below the view"}


class TabBars:
    """Setup of the tab bars of docks, which Qt creates, empties and reuses as docks move.

    Parameters
    ----------
    main : QMainWindow
    close_drawer : callable
        Called when a tab of the drawer is double-clicked.
    """

    def __init__(self, main: QMainWindow, close_drawer: Callable[[], object]):
        self._main, self._close_drawer = main, close_drawer

    def _all(self) -> list[QTabBar]:
        return self._main.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)

    def set_up(self, docks: Iterable[Dock]) -> None:
        """Name the tab bars, and insert those with tabs into the tab order, right before their pages."""
        by_title = {dock.windowTitle(): dock for dock in docks}
        for bar in self._all():
            bar.setFocusPolicy(Qt.FocusPolicy.TabFocus if bar.count() else Qt.FocusPolicy.NoFocus)
            first = next((by_title[title] for title in map(bar.tabText, range(bar.count())) if title in by_title), None)
            if first is None or bar.accessibleName() == tr(_NAMES[first.place]):
                continue
            if not bar.accessibleName():
                bar.setElideMode(Qt.TextElideMode.ElideRight)
                bar.setUsesScrollButtons(False)
                bar.setDrawBase(False)
                bar.tabBarDoubleClicked.connect(lambda _, bar=bar: self._on_double_click(bar))
            bar.setAccessibleName(tr(_NAMES[first.place]))
            before = first.previousInFocusChain()
            while not before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # setTabOrder ignores other widgets
                before = before.previousInFocusChain()
            if before is not bar:
                QWidget.setTabOrder(before, bar)

    def drawer_height(self) -> int:
        """Return the height of the tab bar of the drawer in pixels; 0 if it has none."""
        return sum(bar.height() for bar in self._all() if _is_drawer(bar) and bar.isVisible())

    def _on_double_click(self, bar: QTabBar) -> None:
        if _is_drawer(bar):
            self._close_drawer()


def _is_drawer(bar: QTabBar) -> bool:
    return bar.accessibleName() == tr(_NAMES[PanelPlace.DRAWER])
