"""Where the window's widgets stand: the docks around the view."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QScrollArea, QStyle, QTabBar, QVBoxLayout, QWidget

from hexmend_app.widgets.style import smaller

#: Number of the layout: one that was saved with other docks is not restored.
LAYOUT = 6

#: Pixels that a column has to spare, for words that are longer once there are figures in them.
_LONGER = 8


class _Column(QScrollArea):
    """Shows what the focus comes to by keys, from within or from elsewhere, which Qt's own scrolls to only from within.

    What a mouse button is pressed on is not moved away under it.
    """

    def __init__(self) -> None:
        super().__init__()
        QApplication.instance().focusChanged.connect(self._follow)

    def _follow(self, before: QWidget | None, now: QWidget | None) -> None:
        if now is not None and self.isAncestorOf(now) and not QApplication.mouseButtons():
            self.ensureWidgetVisible(now)


def column(*parts: QWidget) -> QScrollArea:
    """Widgets one below the other, that scroll where there is no room."""
    tools = QWidget()
    layout = QVBoxLayout(tools)
    layout.setContentsMargins(8, 6, 8, 6)
    layout.setSpacing(8)
    for part in parts:
        layout.addWidget(part)
    layout.addStretch()
    scroll = _Column()
    scroll.setWidget(tools)
    scroll.setWidgetResizable(True)
    scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    scroll.setFrameShape(QScrollArea.Shape.NoFrame)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    bar = scroll.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
    scroll.setMinimumWidth(tools.minimumSizeHint().width() + bar + _LONGER)
    return scroll


def add_docks(
    window: QMainWindow,
    tools: QWidget,
    histogram: QWidget,
    tabs: list[tuple[str, str, QWidget]],
    behind: list[tuple[str, str, QWidget]],
) -> dict[str, QDockWidget]:
    """Put tools at the right, a histogram below with others behind it, and beside it tabs, the first in front.

    Parameters
    ----------
    window : QMainWindow
    tools, histogram : QWidget
    tabs, behind : list of (name, title, widget)

    Returns
    -------
    dict
        Docks by name.
    """
    areas = Qt.DockWidgetArea
    window.setDockNestingEnabled(True)
    window.setCorner(Qt.Corner.BottomRightCorner, areas.RightDockWidgetArea)
    docks = {"tools": _dock(window, "tools", "Smooth, cut and colour", tools, areas.RightDockWidgetArea)}
    below = docks["histogram"] = _dock(window, "histogram", "Distribution", histogram, areas.BottomDockWidgetArea)
    for name, title, widget in tabs:
        docks[name] = _dock(window, name, title, widget, areas.BottomDockWidgetArea)
    first, *others = (docks[name] for name, _, _ in tabs)
    window.splitDockWidget(below, first, Qt.Orientation.Horizontal)
    for before, after in zip([first, *others], others, strict=False):
        window.tabifyDockWidget(before, after)
    first.raise_()
    for name, title, widget in behind:
        docks[name] = _dock(window, name, title, widget, areas.BottomDockWidgetArea)
        window.tabifyDockWidget(below, docks[name])
    below.raise_()
    window.resizeDocks([below, first], [540, 460], Qt.Orientation.Horizontal)
    window.resizeDocks([below], [270], Qt.Orientation.Vertical)
    return docks


def name_tabs(window: QMainWindow) -> None:
    """Name the tabs of docks, which Qt makes as the window is shown, and keep their words whole."""
    for tabs in window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly):
        tabs.setAccessibleName("Panels")
        tabs.setFont(smaller(tabs.font()))
        tabs.setElideMode(Qt.TextElideMode.ElideNone)
        tabs.setUsesScrollButtons(True)


def _dock(window: QMainWindow, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
    dock = QDockWidget(title)
    dock.setObjectName(name)
    dock.setWidget(widget)
    # A dock behind others is as good as hidden, which Qt does not say: Tab would walk through what cannot be seen.
    policy = widget.sizePolicy()
    policy.setRetainSizeWhenHidden(True)
    widget.setSizePolicy(policy)
    dock.visibilityChanged.connect(widget.setVisible)
    dock.setFeatures(
        QDockWidget.DockWidgetFeature.DockWidgetMovable | QDockWidget.DockWidgetFeature.DockWidgetFloatable
    )
    window.addDockWidget(area, dock)
    return dock
