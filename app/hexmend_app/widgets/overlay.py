"""Overlays: widgets that float over another widget, at a place given by shares of its free width and height."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QWidget

#: Distance of overlays from the edges, in pixels.
MARGIN = 8

_MOUSE_EVENTS = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.MouseButtonRelease,
    QEvent.Type.MouseButtonDblClick,
)


class Overlay(QObject):
    """Placement of a widget over another one, outside its layout: showing the widget moves nothing.

    The widget has its preferred size if it fits, and stays within the other widget. It takes mouse events; wheel events
    are passed to the widget below.

    Parameters
    ----------
    widget : QWidget
        Becomes a child of `over`.
    over : QWidget
    place : (x, y)
        Position as shares of the free width and height: (0, 0) is the upper left corner, (1, 0.5) the middle of the
        right edge.
    """

    def __init__(self, widget: QWidget, over: QWidget, place: tuple[float, float]):
        super().__init__(widget)
        self._widget, self._over, self._place = widget, over, place
        widget.setParent(over)
        for watched in (widget, over):
            watched.installEventFilter(self)
        self.fit()

    def fit(self) -> None:
        """Set size and position of the widget."""
        self._widget.ensurePolished()
        space = self._over.size() - QSize(2 * MARGIN, 2 * MARGIN)
        size = self._widget.sizeHint().boundedTo(space).expandedTo(QSize(1, 1))
        free = (space - size).expandedTo(QSize(0, 0))
        x, y = self._place
        corner = QPoint(MARGIN + round(x * free.width()), MARGIN + round(y * free.height()))
        self._widget.setGeometry(QRect(corner, size))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Update the geometry, and keep the mouse from the widget below."""
        kind = event.type()
        if kind in (QEvent.Type.Show, QEvent.Type.LayoutRequest) or (
            kind == QEvent.Type.Resize and watched is self._over
        ):
            self.fit()
            if kind == QEvent.Type.Show and watched is self._widget:
                self._widget.raise_()
                self._insert_in_tab_order()
        elif kind in _MOUSE_EVENTS and watched is self._widget:
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _insert_in_tab_order(self) -> None:
        """Insert the controls of all overlays into the tab order, after the widget below, from the top down."""
        tabs = Qt.FocusPolicy.TabFocus
        before = self._over
        if before.focusPolicy() & tabs:
            for overlay in sorted(before.findChildren(Overlay), key=lambda one: one._place[::-1]):
                for part in overlay._widget.findChildren(QWidget):
                    if part.focusPolicy() & tabs:
                        QWidget.setTabOrder(before, part)
                        before = part
