"""Plot of the histogram, in which the mouse brushes a range, and the row of controls for the ends of the range."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import zip_longest
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QToolButton, QVBoxLayout, QWidget

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Axis
from hexmend_app.report.histogram import Histogram, Series
from hexmend_app.theme.palette import BLUE, INVERTED, INVERTED_TEXT, KEPT
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import narrow, on_theme_change, push_button, set_help, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.legend import swatch_icon
from hexmend_app.widgets.metric_texts import in_sentence
from hexmend_app.widgets.plots import MouseView, calm_plot

_INVERTED = "Show inverted hexes as well, of any value; they have a separate column left of the bins."
#: Width of the fields in pixels. It does not depend on the metric, so that the width of the column of panels does not
#: either.
_WIDTH = 68


class HistogramPlot(QWidget):
    """Draws a histogram.

    Attributes
    ----------
    plot : pyqtgraph.PlotWidget
    view : MouseView
    region : pyqtgraph.LinearRegionItem
        Range that is shown; the mouse moves it, and its ends.
    histogram : Histogram or None
        The histogram that is drawn.

    Signals
    -------
    brushed(left, right)
        The user dragged a range to these positions.
    """

    brushed = Signal(float, float)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.view = MouseView()
        self.view.setCursor(Qt.CursorShape.CrossCursor)
        self.plot = calm_plot(self.view)
        self.plot.setMinimumHeight(70)
        self.plot.getAxis("bottom").setHeight(2 * self.fontMetrics().height() + 2)
        self.histogram: Histogram | None = None
        self._axes: tuple[Any, ...] = ()  # what the axes show
        self._bars = [pg.BarGraphItem(x0=[], x1=[], y0=[], y1=[], pen=None)]
        self._lines = [pg.PlotCurveItem() for _ in range(2 + len(KEPT))]
        self.number = pg.TextItem(anchor=(0, 0))
        self.number.setFont(tabular(smaller(self.font())))
        self.region = pg.LinearRegionItem((0, 1), swapMode="block")
        self.region.setCursor(Qt.CursorShape.SizeAllCursor)
        for line in self.region.lines:
            line.setCursor(Qt.CursorShape.SplitHCursor)
        self.region.setZValue(50)
        self.region.hide()
        for item in (*self._bars, *self._lines, self.number, self.region):
            self.plot.addItem(item, ignoreBounds=True)
        self.region.sigRegionChanged.connect(lambda: self.brushed.emit(*self.region.getRegion()))
        self.view.dragged.connect(lambda start, end: self.brushed.emit(*sorted((start.x(), end.x()))))
        fill(QVBoxLayout(self), self.plot, margins=(0, 0, 0, 0))
        on_theme_change(self, self._paint)

    def _paint(self) -> None:
        self.number.setColor(str(INVERTED_TEXT))
        self.region.setBrush(f"{BLUE}20")
        self.region.setHoverBrush(f"{BLUE}30")
        for line in self.region.lines:
            line.setPen(str(BLUE), width=1.5)

    def draw(self, histogram: Histogram, inverted: int) -> None:
        """Draw a histogram; `inverted` is the number above the column of inverted hexes."""
        self.histogram = histogram
        filled = [series for series in histogram.series if series.filled]
        lines = [series for series in histogram.series if not series.filled]
        for items, series in ((self._bars, filled), (self._lines, lines)):
            for item, one in zip_longest(items, series):
                item.setVisible(one is not None)
                if one is not None:
                    self._draw_series(item, one)
        axes = histogram.log, histogram.ylabel, histogram.xlabel, tuple(histogram.ticks)
        if axes != self._axes:  # pyqtgraph draws axes anew after each call
            self._axes = axes
            self._set_axes(histogram)
        floor, top = self._ends
        self.plot.setXRange(*histogram.extent, padding=0)
        self.plot.setYRange(floor, top, padding=0)
        column = histogram.column
        with QSignalBlocker(self.region):
            self.region.setBounds((column[0] if column else 0, histogram.bins))
        self.number.setVisible(column is not None)
        if column is not None:
            self.number.setText(tr("{count:,} inverted", count=inverted))
            self.number.setPos(QPointF(column[1], top))
        self.plot.scene().prepareForPaint()  # otherwise pyqtgraph moves its items while it paints, and paints again

    def _set_axes(self, histogram: Histogram) -> None:
        left, bottom = self.plot.getAxis("left"), self.plot.getAxis("bottom")
        left.setLogMode(x=False, y=histogram.log)
        left.setLabel(histogram.ylabel)
        bottom.setLabel(histogram.xlabel)
        bottom.setTicks([histogram.ticks])
        for axis in (left, bottom):
            axis.resizeEvent()  # centres the label, which pyqtgraph does only when the plot is resized

    @property
    def _ends(self) -> np.ndarray:
        return self._height(self.histogram.heights)

    def _height(self, counts: Sequence[float] | np.ndarray) -> np.ndarray:
        """Return the heights of counts on the plot: their logarithms on a logarithmic axis."""
        counts = np.asarray(counts, dtype=float)
        return np.log10(np.maximum(counts, self.histogram.heights[0])) if self.histogram.log else counts

    def height_at(self, x: float) -> float:
        """Return the height of the tallest bar at a position of the plot."""
        bin = math.floor(x)
        return max((self._height(one.counts)[bin] for one in self.histogram.series if one.filled), default=-math.inf)

    def _draw_series(self, item: pg.BarGraphItem | pg.PlotCurveItem, series: Series) -> None:
        edges, heights = self.histogram.steps(series)
        floor, top = self._ends
        heights = np.minimum(self._height(heights), top)
        if series.filled:
            alpha = "ff" if series.colours else "70"
            brushes = [f"{colour}{alpha}" for colour in self.histogram.step_colours(series)]
            item.setOpts(x0=edges[:-1], x1=edges[1:], y0=np.full(len(heights), floor), y1=heights, brushes=brushes)
        else:
            item.setData(edges, heights, stepMode="center", pen=pg.mkPen(series.colour, width=1.6))

    def show_range(self, span: tuple[float, float] | None) -> None:
        """Show a range by its ends on the plot, without a signal; None for no range."""
        self.region.setVisible(span is not None)
        if span is not None:
            with QSignalBlocker(self.region):
                self.region.setRegion(span)


class RangeRow(QWidget):
    """Fields for the lowest and highest value that is shown, and a button for inverted hexes.

    Signals
    -------
    chosen(Show or None)
        The user changed an end of the range, showed or hid inverted hexes, or chose all hexes (None).
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis, self._range = Axis("q"), Show()
        self.low, self.high = QLineEdit(), QLineEdit()
        self.all = push_button(
            tr("All"), tr("Show the hexes of all values (or double-click the plot)."), name=tr("Show all")
        )
        narrow(self.all)
        self.all.clicked.connect(lambda: self.chosen.emit(None))
        self.inverted = QToolButton()
        self.inverted.setCheckable(True)
        self.inverted.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.inverted.setIcon(swatch_icon(INVERTED))
        self.inverted.setIconSize(QSize(12, 12))
        set_help(self.inverted, tr("Show inverted"), tr(_INVERTED))
        self.inverted.clicked.connect(lambda on: self._choose(replace(self._range, inverted=on)))
        for box in (self.low, self.high):
            box.setFixedWidth(_WIDTH)
            box.setAlignment(Qt.AlignmentFlag.AlignRight)
            box.setFont(tabular(box.font()))
            box.editingFinished.connect(lambda box=box: self._on_end(box))
        parts = (self.low, QLabel(tr("to")), self.high, self.inverted, None, self.all)
        fill(QHBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=4)
        self.show_range(self._axis, None)

    def show_range(self, axis: Axis, range: Show | None) -> None:
        """Show a range of a metric, or None for all hexes, without a signal."""
        metric = in_sentence(METRICS[axis.metric])
        for box, name in ((self.low, tr("Minimum {metric} shown")), (self.high, tr("Maximum {metric} shown"))):
            name = name.format(metric=metric)
            set_help(
                box,
                name,
                tr("{name}; hexes beyond it are hidden. Dragging over the plot sets the same range.", name=name),
            )
        self.all.setEnabled(range is not None)
        minimum, maximum = METRICS[axis.metric].full_range
        self._axis, self._range = axis, range or Show((minimum, maximum), axis.metric, inverted=True)
        self.inverted.setChecked(self._range.inverted)
        ends = (max(self._range.low, minimum), min(self._range.high, maximum))
        for box, end in zip((self.low, self.high), ends, strict=True):
            if not box.isModified():  # not while a number is typed
                box.setText(_text(end))

    def _on_end(self, box: QLineEdit) -> None:
        """Use a new number; a text that is none is replaced by the end of the range."""
        if not box.isModified():  # a brushed end has more digits than its field
            return
        box.setModified(False)
        is_low = box is self.low
        try:
            end = _number(box.text())
        except ValueError:
            end = self._range.low if is_low else self._range.high
        # Inverted hexes are left of all values: a lower end excludes them.
        if is_low and self._range.low <= METRICS[self._axis.metric].full_range[0]:
            self.inverted.setChecked(False)
        low, high = sorted((end, self._range.high) if is_low else (self._range.low, end))
        self._choose(Show((low, high), self._axis.metric, self.inverted.isChecked()))

    def _choose(self, range: Show) -> None:
        minimum, maximum = METRICS[range.metric].full_range
        everything = range.inverted and range.low <= minimum and range.high >= maximum
        self.show_range(self._axis, None if everything else range)
        self.chosen.emit(None if everything else range)


def _text(value: float) -> str:
    return f"{value:.6g}".replace("inf", "∞").replace("-", "−")


def _number(text: str) -> float:
    """Read a number in any notation, also infinity; raise ValueError for other texts and nan."""
    number = float(text.strip().replace("−", "-").replace("∞", "inf"))
    if math.isnan(number):
        raise ValueError(text)
    return number
