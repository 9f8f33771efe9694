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

#: Pixels by which Qt rounds the sizes of docks.
_ROUNDING = 2

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
    share_column(main, docks, _SHARES)


def share_column(main: QMainWindow, docks: Sequence[Dock], shares: Sequence[float]) -> None:
    """Give the tools and the figures in the right column shares of the height of the window."""
    firsts = _column(docks)
    heights = [round(share * main.height()) for share in shares]
    if any(abs(dock.height() - height) > _ROUNDING for dock, height in zip(firsts, heights, strict=False)):
        main.resizeDocks(firsts, heights[: len(firsts)], Qt.Orientation.Vertical)


def column_shares(main: QMainWindow, docks: Sequence[Dock]) -> tuple[float, float]:
    """Return the shares of tools and figures in the height of the window; the default ones unless both are shown."""
    shown = [dock for dock in _column(docks) if dock.isVisible() and not dock.isFloating()]
    if len(shown) != 2:
        return _SHARES
    return shown[0].height() / main.height(), shown[1].height() / main.height()


def _column(docks: Sequence[Dock]) -> list[Dock]:
    """Return the docks of tools and of figures that are in front, or the first ones."""
    groups = [[dock for dock in docks if dock.place is place] for place in PLACES[:2]]
    return [next((dock for dock in group if dock.in_front), group[0]) for group in groups if group]


def _column_width(main: QMainWindow) -> int:
    return max(round(main.width() * _COLUMN_SHARE), _MINIMUM_COLUMN)


def reserve_column(main: QMainWindow, width: int = 0) -> Dock:
    """Add an empty dock on the right, `width` pixels wide (0: default width), as a placeholder for later docks."""
    dock = Dock("space", "", "")
    dock.setFeatures(Dock.DockWidgetFeature.NoDockWidgetFeatures)
    dock.setWidget(QWidget())
    main.addDockWidget(RIGHT, dock)
    main.resizeDocks([dock], [width or _column_width(main)], Qt.Orientation.Horizontal)
    return dock
