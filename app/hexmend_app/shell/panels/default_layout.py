"""The default arrangement of docks: tools above figures at the right, the drawer below the view."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock

RIGHT, BOTTOM = Qt.DockWidgetArea.RightDockWidgetArea, Qt.DockWidgetArea.BottomDockWidgetArea

#: Places of docks in their order.
PLACES = (PanelPlace.TOOLS, PanelPlace.FACTS, PanelPlace.DRAWER)

#: Width of the right column as a share of the window's, its minimum in pixels, and the share of tools in its height.
_COLUMN, _MINIMUM_COLUMN, _TOOLS = 0.19, 272, 0.55


def area_of(place: PanelPlace) -> Qt.DockWidgetArea:
    """The area of the main window in which docks of a place are by default."""
    return BOTTOM if place is PanelPlace.DRAWER else RIGHT


def arrange(main: QMainWindow, docks: Sequence[Dock]) -> None:
    """Dock all in their default places, the first of each place in front and the drawer closed."""
    for dock in docks:
        dock.is_open = True
        dock.setFloating(False)
        main.removeDockWidget(dock)
    for place in PLACES:
        group = [dock for dock in docks if dock.place is place]
        for dock in group:
            main.addDockWidget(area_of(place), dock)
            dock.setVisible(place is not PanelPlace.DRAWER)
        for before, dock in pairwise(group):
            main.tabifyDockWidget(before, dock)
        for dock in group[:1]:
            dock.raise_()
    size(main, docks)


def size(main: QMainWindow, docks: Sequence[Dock]) -> None:
    """Give the right column its default size."""
    firsts = [next((dock for dock in docks if dock.place is place), None) for place in PLACES[:2]]
    firsts = [dock for dock in firsts if dock is not None]
    heights = [round(main.height() * share) for share in (_TOOLS, 1 - _TOOLS)]
    main.resizeDocks(firsts, [_column(main)] * len(firsts), Qt.Orientation.Horizontal)
    main.resizeDocks(firsts, heights[: len(firsts)], Qt.Orientation.Vertical)


def _column(main: QMainWindow) -> int:
    return max(round(main.width() * _COLUMN), _MINIMUM_COLUMN)


def reserve_column(main: QMainWindow, width: int = 0) -> Dock:
    """Add an empty dock at the right, `width` pixels wide (0: by default), for docks that are added later."""
    dock = Dock("space", "", "")
    dock.setFeatures(Dock.DockWidgetFeature.NoDockWidgetFeatures)
    dock.setWidget(QWidget())
    main.addDockWidget(RIGHT, dock)
    main.resizeDocks([dock], [width or _column(main)], Qt.Orientation.Horizontal)
    return dock
