"""Tab bars that Qt creates for docks."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QTabBar, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.translation import tr

#: Property of tab bars that have been set up.
_SET_UP = "set_up"

#: Accessible names of the tab bars.
_NAMES = {PanelPlace.TOOLS: "Tools", PanelPlace.FACTS: "Figures", PanelPlace.DRAWER: "Panels below the view"}


def set_up_tab_bars(main: QMainWindow, docks: Sequence[Dock]) -> None:
    """Name the tab bars of docks, and let Tab reach each right before the page of its first dock.

    A double click on a tab makes its dock a window of its own. Qt creates, empties and reuses the bars as docks move.
    """
    by_title = {dock.windowTitle(): dock for dock in docks}
    for bar in main.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly):
        first = next((by_title[title] for title in map(bar.tabText, range(bar.count())) if title in by_title), None)
        used = bar.count() > 1 and bar.isVisible()  # Qt keeps bars that are not needed
        bar.setFocusPolicy(Qt.FocusPolicy.TabFocus if used else Qt.FocusPolicy.NoFocus)
        bar.setAccessibleName(tr(_NAMES[first.place]) if used and first is not None else "")
        if not bar.property(_SET_UP):
            bar.setProperty(_SET_UP, True)
            bar.setElideMode(Qt.TextElideMode.ElideRight)
            bar.setUsesScrollButtons(False)
            bar.setDrawBase(False)
            bar.tabBarDoubleClicked.connect(lambda at, bar=bar: _float(main, bar.tabText(at)))
        if used and first is not None:
            _reach_before(bar, first)


def _reach_before(bar: QTabBar, dock: Dock) -> None:
    before = dock.previousInFocusChain()
    while not before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # setTabOrder ignores other widgets
        before = before.previousInFocusChain()
    if before is not bar:
        QWidget.setTabOrder(before, bar)


def _float(main: QMainWindow, title: str) -> None:
    docks = main.findChildren(Dock, options=Qt.FindChildOption.FindDirectChildrenOnly)
    for dock in [dock for dock in docks if dock.windowTitle() == title and not dock.isFloating()]:
        dock.show_title(True)
        dock.setFloating(True)
