"""View of a plot in which the mouse brushes a range of positions."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGraphicsSceneHoverEvent

#: Distance from an end of the range, in pixels, within which a drag moves this end.
_GRAB_DISTANCE = 6

_CURSORS = {
    "new": Qt.CursorShape.CrossCursor,
    "move": Qt.CursorShape.SizeAllCursor,
    "bar": Qt.CursorShape.PointingHandCursor,
}


class BrushView(pg.ViewBox):
    """View in which a drag moves the range, one of its ends, or outside of it begins a new range.

    The view announces brushed ranges but does not set `range`, which is up to its owner.

    Attributes
    ----------
    range : (low, high) or None
        Positions of the range that is shown.
    limits : (low, high)
        Limits of brushed ranges.
    bar : (left, right) or None
        Ends of the bar that can be clicked; None if it is empty.

    Signals
    -------
    brushed((low, high))
        The user dragged to this range.
    cleared
        The user double-clicked outside of the bar.
    bar_clicked
        The user clicked the bar.
    """

    brushed = Signal(object)
    cleared = Signal()
    bar_clicked = Signal()

    def __init__(self):
        super().__init__(enableMenu=False, defaultPadding=0)
        self.range: tuple[float, float] | None = None
        self.limits = (0.0, 1.0)
        self.bar: tuple[float, float] | None = None
        self._mode = ""
        self._range_at_start = (0.0, 0.0)
        self.setAcceptHoverEvents(True)

    def _mode_at(self, x: float) -> str:
        """Return the effect of a drag from x: "low", "high", "move" or "new"."""
        if self.range is None:
            return "new"
        low, high = self.range
        if min(abs(x - low), abs(x - high)) <= _GRAB_DISTANCE * self.viewPixelSize()[0]:
            return "low" if abs(x - low) < abs(x - high) else "high"
        return "move" if low < x < high else "new"

    def mouseDragEvent(self, ev, axis=None) -> None:
        """Move the range or one of its ends, or begin a new range."""
        if ev.button() != Qt.MouseButton.LeftButton:
            ev.ignore()
            return
        ev.accept()
        start = self.mapToView(ev.buttonDownPos()).x()
        x = self.mapToView(ev.pos()).x()
        if ev.isStart():
            self._mode = self._mode_at(start)
            self._range_at_start = self.range or (start, start)
        (low, high), (minimum, maximum) = self._range_at_start, self.limits
        if self._mode == "move":
            shift = min(max(x - start, minimum - low), maximum - high)
            ends = (low + shift, high + shift)
        else:
            fixed = {"low": high, "high": low, "new": start}[self._mode]
            ends = (min(fixed, x), max(fixed, x))
        low, high = (min(max(end, minimum), maximum) for end in ends)
        self.brushed.emit((low, high))

    def mouseClickEvent(self, ev) -> None:
        """Announce a click on the bar, or a double click elsewhere."""
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
        """Leave the wheel to the parent, which scrolls."""
        ev.ignore()

    def hoverMoveEvent(self, event: QGraphicsSceneHoverEvent) -> None:
        """Show by the cursor what a drag or click would do."""
        x = self.mapToView(event.pos()).x()
        mode = "bar" if self._on_bar(x) else self._mode_at(x)
        self.setCursor(_CURSORS.get(mode, Qt.CursorShape.SplitHCursor))
