"""Widgets that lie over others, at a place given as shares of what they lie over."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QWidget

from hexmend_app.state.settings.settings import overlay_position

_MARGIN = 8

#: Share of the greatest height that is to be had anywhere, with which it stands nearer to where it belongs.
_ENOUGH = 0.8

_ELSEWHERE = (QEvent.Type.Show, QEvent.Type.Hide, QEvent.Type.Move, QEvent.Type.Resize)
_MOUSE = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.MouseButtonRelease,
    QEvent.Type.MouseButtonDblClick,
)


class Overlay(QObject):
    """Keeps a widget over another one, whose layout knows nothing of it: what comes and goes there moves nothing.

    The widget is as large as it wants to be where there is room. It never leaves what it lies over, and the mouse on it
    is its own; the wheel goes on to what is below.

    Parameters
    ----------
    widget : QWidget
        Becomes a child of `over`.
    over : QWidget
    home : (x, y)
        Where it stands, as shares of the room beside it: (0, 0) is the upper left corner, (1, 0.5) the middle of the
        right edge.
    width : int, optional
        Of the widget, where there is room; by itself it is as wide as it wants to be.
    key : str, optional
        Under which the settings keep its place. With it, the widget can be dragged elsewhere, and a double click puts
        it back.
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
        self._grip: QPoint | None = None  # where on the widget the mouse holds it
        self._others: dict[QWidget, Callable[[], QRect]] = {}  # what it keeps off, and where that is in `over`
        widget.setParent(over)
        if key:
            widget.setCursor(Qt.CursorShape.OpenHandCursor)
        for watched in (widget, over):
            watched.installEventFilter(self)
        self.fit()

    @property
    def place(self) -> tuple[float, float]:
        """Position as shares of the free width and height."""
        return self._place

    def move_to(self, place: tuple[float, float]) -> None:
        """Stand elsewhere."""
        self._place = tuple(min(max(share, 0.0), 1.0) for share in place)
        self.fit()

    def keep_off(self, other: QWidget, part: Callable[[], QRect] | None = None) -> None:
        """Stand above or below another widget that lies over the same one, while that is there.

        Parameters
        ----------
        other : QWidget
        part : callable, optional
            The part of it that is to stay free, in its own coordinates; all of it by itself.
        """
        self._others[other] = part or other.rect
        other.installEventFilter(self)
        self.fit()

    def fit(self) -> None:
        """Stand where it has to, as large as there is room for."""
        size = self._size()
        space = self._space(size)
        x, y = (round(_MARGIN + share * most) for share, most in zip(self._place, space, strict=True))
        self._widget.setGeometry(self._next_to_others(QRect(QPoint(x, y), size)))
        self._widget.raise_()

    def _next_to_others(self, wanted: QRect) -> QRect:
        """The place nearest to a wanted one, as high as there is room for, that leaves free what has to be."""
        bottom = self._over.height()
        taken = [(bottom, bottom)]
        for other, part in self._others.items():
            area = part().translated(other.pos())
            if not other.isHidden() and area.left() <= wanted.right() and area.right() >= wanted.left():
                taken.append((area.top(), area.bottom() + 1))
        free, above = [], 0
        for top, below in sorted(taken):
            free.append((above + _MARGIN, top - _MARGIN))
            above = max(above, below)

        def within(gap: tuple[int, int]) -> QRect:
            top, bottom = gap
            height = max(min(wanted.height(), bottom - top), 1)
            return QRect(wanted.x(), max(min(wanted.y(), bottom - height), top), wanted.width(), height)

        places = [within(gap) for gap in free]
        enough = _ENOUGH * max(place.height() for place in places)
        return min(
            (place for place in places if place.height() >= enough),
            key=lambda place: abs(place.center().y() - wanted.center().y()),
        )

    def _size(self) -> QSize:
        widget = self._widget
        widget.ensurePolished()
        wanted, most = widget.sizeHint(), self._over.size() - QSize(2 * _MARGIN, 2 * _MARGIN)
        width = min(self._width or wanted.width(), most.width())
        if self._width is not None and widget.hasHeightForWidth():
            wanted.setHeight(widget.heightForWidth(width))
        return QSize(max(width, 1), max(min(wanted.height(), most.height()), 1))

    def _space(self, size: QSize) -> tuple[int, int]:
        free = self._over.size() - size - QSize(2 * _MARGIN, 2 * _MARGIN)
        return max(free.width(), 0), max(free.height(), 0)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow what it lies over, and the mouse."""
        kind = event.type()
        if (
            kind in (QEvent.Type.Show, QEvent.Type.LayoutRequest)
            or (kind == QEvent.Type.Resize and watched is self._over)
            or (kind in _ELSEWHERE and watched in self._others)
        ):
            self.fit()
            if kind == QEvent.Type.Show and watched is self._widget:
                self._follow_in_tabs()
        elif kind in _MOUSE and watched is self._widget:
            self._follow(event)
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _follow_in_tabs(self) -> None:
        """Let Tab come from what it lies over to what is in it."""
        tabs = Qt.FocusPolicy.TabFocus
        before = self._over
        if before.focusPolicy() & tabs:
            for part in self._widget.findChildren(QWidget):
                if part.focusPolicy() & tabs:
                    QWidget.setTabOrder(before, part)
                    before = part

    def _follow(self, event: QMouseEvent) -> None:
        """Move as the mouse does; what is not the mouse's to move stays."""
        if self._setting is None:
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
            self._keep()
        elif kind == QEvent.Type.MouseButtonDblClick:
            self.move_to(self._home)
            self._keep()

    def _drag(self, at: QPointF) -> None:
        corner = self._over.mapFromGlobal(at).toPoint() - self._grip - QPoint(_MARGIN, _MARGIN)
        free_space = self._space(self._widget.size())
        here = corner.x(), corner.y()
        self.move_to(
            tuple(was if most == 0 else x / most for x, most, was in zip(here, free_space, self._place, strict=True))
        )

    def _keep(self) -> None:
        if self._place == self._home:
            self._setting.clear()
        else:
            self._setting.set(self._place)
