"""A plot's view in which a range of x is brushed with the mouse."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGraphicsSceneHoverEvent

#: Pixels around an edge of the range in which a drag moves that edge.
_REACH = 6

_SHAPES = {
    "new": Qt.CursorShape.CrossCursor,
    "move": Qt.CursorShape.SizeAllCursor,
    "bar": Qt.CursorShape.PointingHandCursor,
}


class BrushView(pg.ViewBox):
    """Drags select a range of places: on open ground a new one, on an edge that edge, inside the range all of it.

    Its owner sets the range that is shown; the view never does.

    Attributes
    ----------
    range : (low, high) or None
    reach : (low, high)
        No range goes beyond these.
    bar : (left, right) or None
        Where a click means a bar; None where there is nothing in it.

    Signals
    -------
    brushed((low, high))
        While the mouse is dragged.
    cleared
        Double click.
    bar_clicked
        A click on the bar.
    """

    brushed = Signal(object)
    cleared = Signal()
    bar_clicked = Signal()

    def __init__(self):
        super().__init__(enableMenu=False, defaultPadding=0)
        self.range: tuple[float, float] | None = None
        self.reach = (0.0, 1.0)
        self.bar: tuple[float, float] | None = None
        self._mode = ""
        self._grabbed = (0.0, 0.0)
        self.setAcceptHoverEvents(True)

    def _mode_at(self, x: float) -> str:
        """Return the effect of a drag from x: "low", "high", "move" or "new"."""
        if self.range is None:
            return "new"
        low, high = self.range
        reach = _REACH * self.viewPixelSize()[0]
        if min(abs(x - low), abs(x - high)) <= reach:
            return "low" if abs(x - low) < abs(x - high) else "high"
        return "move" if low < x < high else "new"

    def mouseDragEvent(self, ev, axis=None) -> None:
        """Brush."""
        if ev.button() != Qt.MouseButton.LeftButton:
            ev.ignore()
            return
        ev.accept()
        began = self.mapToView(ev.buttonDownPos()).x()
        x = self.mapToView(ev.pos()).x()
        if ev.isStart():
            self._mode = self._mode_at(began)
            self._grabbed = self.range or (began, began)
        low, high = self._grabbed
        if self._mode == "move":
            shift = min(max(x - began, self.reach[0] - low), self.reach[1] - high)
            ends = (low + shift, high + shift)
        else:
            fixed = {"low": high, "high": low, "new": began}[self._mode]
            ends = (min(fixed, x), max(fixed, x))
        least, most = self.reach
        low, high = (min(max(end, least), most) for end in ends)
        self.brushed.emit((low, high))

    def mouseClickEvent(self, ev) -> None:
        """Tell a click on the bar; clear on a double click elsewhere."""
        if ev.button() != Qt.MouseButton.LeftButton:
            return
        on_bar = self._on_bar(self.mapToView(ev.pos()).x())
        if on_bar or ev.double():
            ev.accept()
        if ev.double() and not on_bar:
            self.cleared.emit()
        elif on_bar and not ev.double():
            self.bar_clicked.emit()

    def _on_bar(self, x: float) -> bool:
        return self.bar is not None and self.bar[0] <= x <= self.bar[1]

    def wheelEvent(self, ev, axis=None) -> None:
        """Leave the wheel to the panel, which scrolls."""
        ev.ignore()

    def hoverMoveEvent(self, event: QGraphicsSceneHoverEvent) -> None:
        """Show by the pointer's shape what a drag would do."""
        x = self.mapToView(event.pos()).x()
        mode = "bar" if self._on_bar(x) else self._mode_at(x)
        self.setCursor(_SHAPES.get(mode, Qt.CursorShape.SplitHCursor))
