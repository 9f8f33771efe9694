"""The plot of the histogram: two distributions, inverted elements apart, and the brushed range."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.widgets.brush import BrushView
from hexmend_app.widgets.histogram_bins import BINS, Distribution, decades, round_up
from hexmend_app.widgets.plots import calm_plot
from hexmend_app.widgets.style import BLUE, GREY, INVERTED, INVERTED_TEXT, dress, smaller, tabular

EDGES = np.linspace(0, 1, BINS + 1)
#: Where on the x axis the bar of inverted elements stands: apart, left of 0.
APART = (-0.19, -0.09)
_LEFT, _RIGHT = -0.25, 1.02
# Where an empty bin ends on the logarithmic axis: below one element.
_LOG_FLOOR = math.log10(0.5)


class HistogramPlot(QWidget):
    """Draws distributions of q(H); knows nothing of what they are of.

    Attributes
    ----------
    plot : pyqtgraph.PlotWidget
    view : BrushView
        Announces what is brushed.
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.view = BrushView()
        self.plot = calm_plot(self.view)
        self._log = False
        self._top = 0.0
        self._make_axes()
        self._make_items()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.plot)

    def _make_axes(self) -> None:
        self.plot.setMinimumHeight(150)
        self.plot.setXRange(_LEFT, _RIGHT, padding=0)
        bottom, left = self.plot.getAxis("bottom"), self.plot.getAxis("left")
        bottom.setTicks([[(sum(APART) / 2, "inverted"), *((x, f"{x:g}") for x in (0, 0.2, 0.4, 0.6, 0.8, 1.0))]])
        bottom.colours["inverted"] = INVERTED_TEXT
        bottom.setLabel("quality q(H)")
        left.setLabel("elements")
        bottom.setHeight(2 * self.fontMetrics().height() + 6)
        left.setWidth(self.fontMetrics().horizontalAdvance("00,000") + 26)
        for axis in (bottom, left):
            axis.label.setFont(smaller(self.font()))

    def _make_items(self) -> None:
        self._region = pg.LinearRegionItem((0, 1), movable=False)
        self._region.setZValue(-10)
        self._region.hide()
        self._was, self._now = _Outline(), _Outline()
        self._number = pg.TextItem(anchor=(0.5, 1.0))
        self._number.setFont(tabular(smaller(self.font())))
        for item in (self._region, *self._was.items, *self._now.items, self._number):
            self.plot.addItem(item, ignoreBounds=True)
        dress(self, self._paint)

    def _paint(self) -> None:
        self._region.setBrush(f"{BLUE}20")
        for line in self._region.lines:
            line.setPen(str(BLUE), width=1.5)
        self._was.paint(str(GREY), str(GREY), "50")
        self._now.paint(str(BLUE), INVERTED, "70")
        self._number.setColor(str(INVERTED_TEXT))

    @property
    def log(self) -> bool:
        """Whether heights go by powers of ten."""
        return self._log

    def set_log(self, log: bool) -> None:
        """Choose the scale of the counts; it shows with the next `draw`."""
        self._log = log
        self._top = 0.0

    def draw(self, initial: Distribution | None, current: Distribution | None) -> None:
        """Draw the distribution at the start behind the one now."""
        floor = _LOG_FLOOR if self._log else 0.0
        known = [part for part in (initial, current) if part is not None]
        self._fit_axis(floor, max((max(int(part.counts.max()), part.inverted) for part in known), default=1))
        self._was.draw(initial, self._heights, floor)
        self._now.draw(current, self._heights, floor)
        self._number.setText(f"{current.inverted:,}" if current else "")
        top = max((part.inverted for part in known), default=0)
        self._number.setPos(QPointF(sum(APART) / 2, float(self._heights(top))))

    def show_range(self, range: tuple[float, float] | None) -> None:
        """Show what is brushed."""
        self.view.range = range
        self._region.setVisible(range is not None)
        self._region.setRegion(range or (0.0, 1.0))

    def _heights(self, counts: np.ndarray | int) -> np.ndarray:
        return np.log10(np.maximum(counts, 0.5)) if self._log else np.asarray(counts, dtype=float)

    def _fit_axis(self, floor: float, most: int) -> None:
        """Let the axis grow with the counts, and shrink only when they need less than half of it."""
        if self._top / 2 <= most <= self._top:
            return
        self._top = round_up(most)
        left = self.plot.getAxis("left")
        if self._log:
            high = math.log10(self._top)
            left.setTicks([[(math.log10(n), f"{n:,}") for n in decades(self._top)]])
        else:
            high = self._top
            left.setTicks([[(n, f"{n:,.0f}") for n in np.linspace(0, high, 5) if n == round(n)]])
        # Room above for the number that stands on the bar.
        self.plot.setYRange(floor, floor + (high - floor) * 1.22, padding=0)


class _Outline:
    """The items of one distribution: a filled outline over the bins, and a bar for inverted elements."""

    def __init__(self):
        self._curve = pg.PlotCurveItem(EDGES, np.zeros(BINS), stepMode="center", fillLevel=0)
        self._bar = pg.BarGraphItem(x0=[0.0], x1=[0.0], height=[0.0])
        self.items = (self._curve, self._bar)
        self._drawn: tuple[Distribution | None, float] | None = None

    def paint(self, colour: str, apart_colour: str, alpha: str) -> None:
        """Take colours."""
        self._curve.setPen(colour)
        self._curve.setBrush(colour + alpha)
        self._bar.setOpts(pen=pg.mkPen(apart_colour), brush=pg.mkBrush(apart_colour + alpha))

    def draw(self, part: Distribution | None, heights: Callable, floor: float) -> None:
        """Show a distribution, its counts mapped by `heights` and standing on `floor`."""
        # During a run only the distribution now changes.
        if self._drawn is not None and self._drawn[0] is part and self._drawn[1] == floor:
            return
        self._drawn = (part, floor)
        self._curve.setVisible(part is not None)
        self._bar.setVisible(part is not None and part.inverted > 0)
        if part is not None:
            self._curve.setData(EDGES, heights(part.counts), fillLevel=floor)
            self._bar.setOpts(x0=[APART[0]], x1=[APART[1]], y0=[floor], height=[float(heights(part.inverted)) - floor])
