"""Dock whose page is visible only while the dock is in front, and the tab bars that Qt creates for docks."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.translation import tr

#: Property of tab bars that have been set up.
_SET_UP = "set_up"
#: Accessible names of the tab bars.
_NAMES = {PanelPlace.TOOLS: "Tools", PanelPlace.FACTS: "Figures", PanelPlace.DRAWER: "Panels below the view"}


class Dock(QDockWidget):
    """Dock widget with one or several panels.

    Qt keeps docks behind other tabs visible, outside the window: Tab reaches them, and their panels are refreshed.
    Therefore the page is hidden unless the dock is in front.

    Parameters
    ----------
    name : str
        Object name, under which Qt saves its place.
    title, help : str
    place : PanelPlace
        Default place.

    Attributes
    ----------
    in_front : bool
        It is visible, not behind another tab.
    """

    def __init__(self, name: str, title: str, help: str, place: PanelPlace, parent: QWidget | None = None):
        super().__init__(title, parent)
        self.setObjectName(name)
        self.setToolTip(help)
        self.place = place
        self.in_front = False
        self._no_title = QWidget()  # as title bar: no title
        self.visibilityChanged.connect(self.set_in_front)

    def set_page(self, page: QWidget) -> None:
        """Set the page, which keeps its space in the layout while it is hidden."""
        policy = page.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        page.setSizePolicy(policy)
        self.setWidget(page)
        page.setVisible(self.in_front)

    def show_title(self, on: bool) -> None:
        """Show the title bar, or hide it where a tab shows the title already."""
        if on != (self.titleBarWidget() is None):
            self.setTitleBarWidget(None if on else self._no_title)

    def set_in_front(self, in_front: bool) -> None:
        """Show or hide the page."""
        self.in_front = in_front
        if self.widget() is not None:
            self.widget().setVisible(in_front)


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
