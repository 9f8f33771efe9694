"""Overlays: widgets that float over another widget, with positions as shares of its free width and height."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QWidget

from hexmend_app.state.settings.settings import overlay_position

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
    home : (x, y)
        Default position as shares of the free width and height: (0, 0) is the upper left corner, (1, 0.5) the middle of
        the right edge.
    key : str
        Key under which the settings store the position. The widget can be dragged, and a double click resets its
        position.
    """

    def __init__(self, widget: QWidget, over: QWidget, home: tuple[float, float], key: str):
        super().__init__(widget)
        self._widget, self._over, self._home = widget, over, home
        self._setting = overlay_position(key, home)
        self._place = self._setting.get()
        self._locked = False  # at the default position
        self._grip: QPoint | None = None  # position of a drag on the widget
        widget.setParent(over)
        widget.setCursor(Qt.CursorShape.OpenHandCursor)
        for watched in (widget, over):
            watched.installEventFilter(self)
        self.fit()

    @property
    def place(self) -> tuple[float, float]:
        """Position as shares of the free width and height."""
        return self._home if self._locked else self._place

    def move_to(self, place: tuple[float, float]) -> None:
        """Move the widget to a position, limited to [0, 1]."""
        x, y = place
        self._place = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)
        self.fit()

    def lock_to_default(self, on: bool) -> None:
        """Keep the widget at its default position, where it cannot be dragged; off restores the user's position."""
        if on != self._locked:
            self._locked, self._grip = on, None
            self._widget.setCursor(Qt.CursorShape.ArrowCursor if on else Qt.CursorShape.OpenHandCursor)
            self.fit()

    def fit(self) -> None:
        """Set size and position of the widget, and put it on top."""
        size = self._size()
        x, y = (round(MARGIN + share * free) for share, free in zip(self.place, self._free(size), strict=True))
        self._widget.setGeometry(QRect(QPoint(x, y), size))
        self._widget.raise_()

    def _size(self) -> QSize:
        widget = self._widget
        widget.ensurePolished()
        return widget.sizeHint().boundedTo(self._over.size() - QSize(2 * MARGIN, 2 * MARGIN)).expandedTo(QSize(1, 1))

    def _free(self, size: QSize) -> tuple[int, int]:
        """Return the free width and height next to a widget of a size, in pixels."""
        free = self._over.size() - size - QSize(2 * MARGIN, 2 * MARGIN)
        return max(free.width(), 0), max(free.height(), 0)

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Update the geometry, and handle the mouse."""
        kind = event.type()
        if kind in (QEvent.Type.Show, QEvent.Type.LayoutRequest) or (
            kind == QEvent.Type.Resize and watched is self._over
        ):
            self.fit()
            if kind == QEvent.Type.Show and watched is self._widget:
                self._insert_in_tab_order()
        elif kind in _MOUSE_EVENTS and watched is self._widget:
            self._on_mouse(event)
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _insert_in_tab_order(self) -> None:
        """Insert the controls of the widget into the tab order, after the widget below."""
        tabs = Qt.FocusPolicy.TabFocus
        before = self._over
        if before.focusPolicy() & tabs:
            for part in self._widget.findChildren(QWidget):
                if part.focusPolicy() & tabs:
                    QWidget.setTabOrder(before, part)
                    before = part

    def _on_mouse(self, event: QMouseEvent) -> None:
        """Drag the widget, or reset its position on a double click."""
        if self._locked:
            return
        kind, at = event.type(), event.globalPosition()
        if kind == QEvent.Type.MouseButtonPress and event.button() == Qt.MouseButton.LeftButton:
            self._grip = self._widget.mapFromGlobal(at).toPoint()
        elif kind == QEvent.Type.MouseMove and self._grip is not None:
            self._drag(at)
        elif kind == QEvent.Type.MouseButtonRelease and self._grip is not None:
            self._grip = None
            self._setting.set(self._place)
        elif kind == QEvent.Type.MouseButtonDblClick:
            self.move_to(self._home)
            self._setting.clear()

    def _drag(self, at: QPointF) -> None:
        corner = self._over.mapFromGlobal(at).toPoint() - self._grip - QPoint(MARGIN, MARGIN)
        free = self._free(self._widget.size())
        axes = zip((corner.x(), corner.y()), free, self._place, strict=True)
        x, y = (old if space == 0 else at / space for at, space, old in axes)
        self.move_to((x, y))
