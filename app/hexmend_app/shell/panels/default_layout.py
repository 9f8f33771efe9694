"""Default arrangement of docks: tools above figures on the right, the drawer below the view."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock

RIGHT, BOTTOM = Qt.DockWidgetArea.RightDockWidgetArea, Qt.DockWidgetArea.BottomDockWidgetArea

#: Places of docks, in order.
PLACES = (PanelPlace.TOOLS, PanelPlace.FACTS, PanelPlace.DRAWER)

#: Width of the right column as a share of that of the window, and its minimum in pixels.
_COLUMN_SHARE, _MINIMUM_COLUMN = 0.145, 240

#: Shares of tools and of figures in the height of the window.
_SHARES = 0.55, 0.36


def area_of(place: PanelPlace) -> Qt.DockWidgetArea:
    """Return the default area of the main window for docks of a place."""
    return BOTTOM if place is PanelPlace.DRAWER else RIGHT


def arrange(main: QMainWindow, docks: Sequence[Dock]) -> None:
    """Dock all panels in their default places, with the first of each place in front and the drawer closed."""
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
    firsts = _column(docks)
    main.resizeDocks(firsts, [_column_width(main)] * len(firsts), Qt.Orientation.Horizontal)
    heights = [round(share * main.height()) for share in _SHARES]
    main.resizeDocks(firsts, heights[: len(firsts)], Qt.Orientation.Vertical)


def _column(docks: Sequence[Dock]) -> list[Dock]:
    """Return the docks of tools and of figures that are in front, or the first ones."""
    groups = [[dock for dock in docks if dock.place is place] for place in PLACES[:2]]
    return [next((dock for dock in group if dock.in_front), group[0]) for group in groups if group]


def _column_width(main: QMainWindow) -> int:
    return max(round(main.width() * _COLUMN_SHARE), _MINIMUM_COLUMN)


def reserve_column(main: QMainWindow, width: object) -> Dock:
    """Add an empty dock on the right, some pixels wide or of the default width, as a placeholder for later docks."""
    dock = Dock("space", "", "")
    dock.setFeatures(Dock.DockWidgetFeature.NoDockWidgetFeatures)
    dock.setWidget(QWidget())
    main.addDockWidget(RIGHT, dock)
    width = width if isinstance(width, int) and width > 0 else _column_width(main)
    main.resizeDocks([dock], [width], Qt.Orientation.Horizontal)
    return dock
