"""Mouse on the histogram: a view in which it brushes a range of positions, and handles of the range of colours."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QGraphicsSceneHoverEvent

#: Distance from an end of the range, in pixels, within which a drag moves this end.
_GRAB_DISTANCE = 6

#: Smallest distance of the ends of the range of colours, as a share of the axis.
_LEAST_RANGE = 0.01

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
    clicked(x, y)
        The user clicked elsewhere, at this position of the plot.
    """

    brushed = Signal(object)
    cleared = Signal()
    bar_clicked = Signal()
    clicked = Signal(float, float)

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
        place = self.mapToView(ev.pos())
        on_bar = self._on_bar(place.x())
        ev.accept()
        if ev.double() and not on_bar:
            self.cleared.emit()
        elif on_bar and not ev.double():
            self.bar_clicked.emit()
        elif not ev.double():
            self.clicked.emit(place.x(), place.y())

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


class ColourRange(QObject):
    """Two handles on the axis of a plot that show and move the ends of the range of colours.

    Signals
    -------
    dragged(end, position)
        The user dragged a handle: 0 for the low end, 1 for the high one.

    Attributes
    ----------
    lines : list of pyqtgraph.InfiniteLine
        The handle of the low end, and that of the high one.

    Parameters
    ----------
    plot : pyqtgraph.PlotWidget
    """

    dragged = Signal(int, float)

    def __init__(self, plot: pg.PlotWidget):
        super().__init__(plot)
        self._ends = [0.0, 1.0]  # also beyond the axis
        self.lines: list[pg.InfiniteLine] = []
        for marker in ("|>", "<|"):
            line = pg.InfiniteLine(angle=90, movable=True, bounds=(0.0, 1.0))
            line.addMarker(marker, position=0.5, size=12)
            line.setZValue(50)
            line.sigDragged.connect(lambda line: self.drag(self.lines.index(line), line.value()))
            line.hide()
            plot.addItem(line, ignoreBounds=True)
            self.lines.append(line)

    def paint(self, colour: str, hover: str) -> None:
        """Set the colours of the handles."""
        for line in self.lines:
            line.setPen(pg.mkPen(colour, width=1, style=Qt.PenStyle.DashLine))
            line.setHoverPen(pg.mkPen(hover, width=2))

    def end_at(self, height: float) -> None:
        """Let the handles end at a fraction of the height of the plot, below its legend."""
        for line in self.lines:
            line.setSpan(0.0, height)

    def show_ends(self, ends: tuple[float, float] | None) -> None:
        """Show the handles at two positions, at the nearest end of the axis if beyond it; hide them for None."""
        for line in self.lines:
            line.setVisible(ends is not None)
        if ends is not None and not any(line.moving for line in self.lines):
            self._ends[:] = ends
            self._place()

    @property
    def shown(self) -> bool:
        """True if the handles are shown."""
        return any(line.isVisible() for line in self.lines)

    def handles(self) -> tuple[float, float]:
        """Return the positions of both handles."""
        return self.lines[0].value(), self.lines[1].value()

    def _place(self) -> None:
        for line, end in zip(self.lines, self._ends, strict=True):
            with QSignalBlocker(line):
                line.setValue(min(max(end, 0.0), 1.0))

    def drag(self, end: int, position: float) -> None:
        """Move one end, 0 or 1, to a position; it stays on its side of the other end."""
        limit = self._ends[1 - end] + (2 * end - 1) * _LEAST_RANGE
        self._ends[end] = max(position, limit) if end else min(position, limit)
        self._place()
        self.dragged.emit(end, self._ends[end])
