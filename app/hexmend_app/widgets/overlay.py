"""Overlays: widgets that float over another widget, with positions as shares of its free width and height."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QWidget

from hexmend_app.state.settings.settings import overlay_position

#: Distance of overlays from the edges, in pixels.
MARGIN = 8

#: Share of the maximum available height that a gap must have to be chosen because it is nearer.
_SUFFICIENT_HEIGHT = 0.8

_GEOMETRY_EVENTS = (QEvent.Type.Show, QEvent.Type.Hide, QEvent.Type.Move, QEvent.Type.Resize)
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
    width : int, optional
        Maximum width in pixels; by default the preferred width.
    key : str, optional
        Key under which the settings store the position. With it, the widget can be dragged, and a double click resets
        its position.
    """

    def __init__(
        self,
        widget: QWidget,
        over: QWidget,
        home: tuple[float, float],
        width: int | None = None,
        key: str | None = None,
    ):
        super().__init__(widget)
        self._widget, self._over, self._home, self._width = widget, over, home, width
        self._setting = overlay_position(key, home) if key else None
        self._place = self._setting.get() if key else home
        self._at_home = False  # True while the position of the user is ignored
        self._grip: QPoint | None = None  # position of a drag on the widget
        self._others: dict[QWidget, Callable[[], QRect]] = {}  # widgets to avoid, with their areas
        widget.setParent(over)
        if key:
            widget.setCursor(Qt.CursorShape.OpenHandCursor)
        for watched in (widget, over):
            watched.installEventFilter(self)
        self.fit()

    @property
    def place(self) -> tuple[float, float]:
        """Position as shares of the free width and height."""
        return self._home if self._at_home else self._place

    def move_to(self, place: tuple[float, float]) -> None:
        """Move the widget to a position, limited to [0, 1]."""
        x, y = place
        self._place = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)
        self.fit()

    def stay_home(self, on: bool) -> None:
        """Keep the widget at its default position, where it cannot be dragged; off restores the user's position."""
        if on != self._at_home:
            self._at_home, self._grip = on, None
            if self._setting is not None:
                self._widget.setCursor(Qt.CursorShape.ArrowCursor if on else Qt.CursorShape.OpenHandCursor)
            self.fit()

    def keep_off(self, other: QWidget, part: Callable[[], QRect] | None = None) -> None:
        """Stay above or below another overlay of the same widget while that is visible.

        Parameters
        ----------
        other : QWidget
        part : callable, optional
            Returns the area of `other` to avoid, in its own coordinates; by default all of it.
        """
        self._others[other] = part or other.rect
        other.installEventFilter(self)
        self.fit()

    def fit(self) -> None:
        """Set size and position of the widget, and put it on top."""
        size = self._size()
        x, y = (round(MARGIN + share * free) for share, free in zip(self.place, self._free(size), strict=True))
        self._widget.setGeometry(self._avoiding_others(QRect(QPoint(x, y), size)))
        self._widget.raise_()

    def _avoiding_others(self, wanted: QRect) -> QRect:
        """Return the nearest rectangle to the wanted one without overlapping other widgets, lower if necessary."""
        bottom = self._over.height()
        occupied = [(bottom, bottom)]
        for other, part in self._others.items():
            area = part().translated(other.pos())
            if not other.isHidden() and area.left() <= wanted.right() and area.right() >= wanted.left():
                occupied.append((area.top(), area.bottom() + 1))
        gaps, above = [], 0
        for top, below in sorted(occupied):
            gaps.append((above + MARGIN, top - MARGIN))
            above = max(above, below)

        def within(gap: tuple[int, int]) -> QRect:
            top, bottom = gap
            height = max(min(wanted.height(), bottom - top), 1)
            return QRect(wanted.x(), max(min(wanted.y(), bottom - height), top), wanted.width(), height)

        rects = [within(gap) for gap in gaps]
        sufficient = _SUFFICIENT_HEIGHT * max(rect.height() for rect in rects)
        return min(
            (rect for rect in rects if rect.height() >= sufficient),
            key=lambda rect: abs(rect.center().y() - wanted.center().y()),
        )

    def _size(self) -> QSize:
        widget = self._widget
        widget.ensurePolished()
        wanted, available = widget.sizeHint(), self._over.size() - QSize(2 * MARGIN, 2 * MARGIN)
        width = min(self._width or wanted.width(), available.width())
        if self._width is not None and widget.hasHeightForWidth():
            wanted.setHeight(widget.heightForWidth(width))
        return QSize(max(width, 1), max(min(wanted.height(), available.height()), 1))

    def _free(self, size: QSize) -> tuple[int, int]:
        """Return the free width and height next to a widget of a size, in pixels."""
        free = self._over.size() - size - QSize(2 * MARGIN, 2 * MARGIN)
        return max(free.width(), 0), max(free.height(), 0)

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Update the geometry when the other widgets move, and handle the mouse."""
        kind = event.type()
        if (
            kind in (QEvent.Type.Show, QEvent.Type.LayoutRequest)
            or (kind == QEvent.Type.Resize and watched is self._over)
            or (kind in _GEOMETRY_EVENTS and watched in self._others)
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
        """Drag the widget, or reset its position on a double click, if its position is a setting."""
        if self._setting is None or self._at_home:
            return
        kind, at = event.type(), event.globalPosition()
        if kind == QEvent.Type.MouseButtonPress and event.button() == Qt.MouseButton.LeftButton:
            self._grip = self._widget.mapFromGlobal(at).toPoint()
            self._widget.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif kind == QEvent.Type.MouseMove and self._grip is not None:
            self._drag(at)
        elif kind == QEvent.Type.MouseButtonRelease and self._grip is not None:
            self._grip = None
            self._widget.setCursor(Qt.CursorShape.OpenHandCursor)
            self._store()
        elif kind == QEvent.Type.MouseButtonDblClick:
            self.move_to(self._home)
            self._store()

    def _drag(self, at: QPointF) -> None:
        corner = self._over.mapFromGlobal(at).toPoint() - self._grip - QPoint(MARGIN, MARGIN)
        free = self._free(self._widget.size())
        axes = zip((corner.x(), corner.y()), free, self._place, strict=True)
        x, y = (old if space == 0 else at / space for at, space, old in axes)
        self.move_to((x, y))

    def _store(self) -> None:
        if self._place == self._home:
            self._setting.clear()
        else:
            self._setting.set(self._place)
