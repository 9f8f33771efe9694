"""The plot of the histogram: distributions, inverted elements apart, and the brushed range."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import Distribution, decades, round_up
from hexmend_app.features.histogram.brush import BrushView
from hexmend_app.scene.palette import Role
from hexmend_app.widgets.plots import calm_plot
from hexmend_app.widgets.style import BLUE, INVERTED, INVERTED_TEXT, dress, smaller, tabular


@dataclass(frozen=True, eq=False)
class Series:
    """A distribution as it is drawn: filled under its outline or not, in a colour; `key` tells it from the others."""

    key: str
    name: str
    colour: Role
    part: Distribution
    filled: bool = False
    current: bool = False


class HistogramPlot(QWidget):
    """Draws distributions; knows nothing of what they are of.

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
        self.plot.setMinimumHeight(110)
        self.axis: Axis | None = None
        self.log = self.cumulative = False
        self._scale: tuple | None = None
        self._outlines: dict[str, _Outline] = {}
        self._shown: Sequence[Series] = ()
        self._region = pg.LinearRegionItem((0, 1), movable=False)
        self._region.setZValue(-10)
        self._region.hide()
        self._number = pg.TextItem(anchor=(0.5, 1.0))
        self._number.setFont(tabular(smaller(self.font())))
        for item in (self._region, self._number):
            self.plot.addItem(item, ignoreBounds=True)
        for name in ("bottom", "left"):
            self.plot.getAxis(name).label.setFont(smaller(self.font()))
        self.plot.getAxis("bottom").setHeight(2 * self.fontMetrics().height() + 6)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.plot)
        dress(self, self._paint)

    def _paint(self) -> None:
        self._region.setBrush(f"{BLUE}20")
        for line in self._region.lines:
            line.setPen(str(BLUE), width=1.5)
        self.plot.getAxis("bottom").colours["inverted"] = INVERTED_TEXT
        self._number.setColor(str(INVERTED_TEXT))
        for outline in self._outlines.values():
            outline.forget()
        self.draw(self._shown)

    def set_axis(self, axis: Axis) -> None:
        """Take the values that the bins span."""
        self.axis = axis
        self.view.reach = axis.reach
        self.plot.setXRange(*axis.extent, padding=0)
        self.plot.getAxis("bottom").setTicks([axis.ticks()])
        self._label("bottom", axis.title)

    def draw(self, drawn: Sequence[Series]) -> None:
        """Draw distributions, the first at the bottom."""
        self._shown = drawn
        floor = self._fit_counts([one.part for one in drawn])
        gone = self._outlines.keys() - {one.key for one in drawn}
        for key in gone:
            for item in self._outlines.pop(key).items:
                self.plot.removeItem(item)
        for at, one in enumerate(drawn):
            if one.key not in self._outlines:
                self._outlines[one.key] = _Outline()
                for item in self._outlines[one.key].items:
                    self.plot.addItem(item, ignoreBounds=True)
            self._outlines[one.key].draw(at, one, self.heights, (floor, self.cumulative, self.log))
        self._number.setVisible(bool(drawn))
        for one in drawn:
            if one.current:
                share = 100 * one.part.inverted / max(one.part.total, 1)
                self._number.setText(f"{share:.3g} %" if self.cumulative else f"{one.part.inverted:,}")
        if drawn:
            most = max(self.heights(one.part, one.part.inverted) for one in drawn)
            self._number.setPos(QPointF(sum(self.axis.inverted) / 2, float(most)))

    def show_range(self, ends: tuple[float, float] | None) -> None:
        """Show what is brushed, by its places on the plot."""
        self.view.range = ends
        self._region.setVisible(ends is not None)
        self._region.setRegion(ends or (0.0, 1.0))

    def heights(self, part: Distribution, counts: np.ndarray | int) -> np.ndarray:
        """Where counts of a distribution lie on the axis of counts, or of shares in percent."""
        heights = np.asarray(counts, dtype=float)
        if self.cumulative:
            heights = heights * (100 / max(part.total, 1))
        if self.log:
            heights = np.log10(np.maximum(heights, 0.5 * self._least(part)))
        return heights

    def _least(self, part: Distribution) -> float:
        """One element, as it is counted."""
        return 100 / max(part.total, 1) if self.cumulative else 1.0

    def _fit_counts(self, parts: Sequence[Distribution]) -> float:
        """Let the axis grow with the counts, and shrink only when they need less than half of it; its floor."""
        if self.cumulative:
            most, least = 100.0, min((self._least(part) for part in parts), default=1.0)
        else:
            ends = [max(int(part.counts.max()), part.inverted, part.below, part.above) for part in parts]
            most, least = max(ends, default=1), 1.0
        if self._scale is not None and self._scale[2:] == (self.log, self.cumulative, least):
            top, floor = self._scale[:2]
            if top / 2 <= most <= top:
                return floor
        top = most if self.cumulative else round_up(most)
        floor = math.log10(0.5 * least) if self.log else 0.0
        self._scale = (top, floor, self.log, self.cumulative, least)
        self._show_counts(top, floor, least)
        return floor

    def _show_counts(self, top: float, floor: float, least: float) -> None:
        left = self.plot.getAxis("left")
        if self.log:
            high = math.log10(top)
            first = 10.0 ** math.ceil(math.log10(least) - 1e-9)
            ticks = [(math.log10(first * n), f"{first * n:,g}") for n in decades(top / first)]
            if len(ticks) > 5:
                ticks = ticks[:: -(-len(ticks) // 5)]
        else:
            high = top
            ticks = [(n, f"{n:,.0f}") for n in np.linspace(0, high, 5) if n == round(n)]
        left.setTicks([ticks])
        self._label("left", "% of elements" if self.cumulative else "elements")
        widest = max((self.fontMetrics().horizontalAdvance(text) for _, text in ticks), default=0)
        left.setWidth(max(widest, self.fontMetrics().horizontalAdvance("00,000")) + 26)
        # Room above for the number that stands on the bar.
        self.plot.setYRange(floor, floor + (high - floor) * 1.22, padding=0)

    def _label(self, name: str, text: str) -> None:
        axis = self.plot.getAxis(name)
        axis.setLabel(text)
        axis.resizeEvent()  # where the text is centred; pyqtgraph thinks of it only as the plot is resized


class _Outline:
    """The items of one distribution: an outline over the bins, a bar for inverted elements, bars beyond the ends."""

    def __init__(self) -> None:
        self._curve = pg.PlotCurveItem()
        self._bar = pg.BarGraphItem(x0=[0.0], x1=[0.0], height=[0.0])
        self._ends = pg.BarGraphItem(x0=[0.0], x1=[0.0], height=[0.0])
        self.items = (self._curve, self._bar, self._ends)
        self._drawn: tuple | None = None

    def forget(self) -> None:
        """Draw anew next time, though nothing but the colours has changed."""
        self._drawn = None

    def draw(self, at: int, series: Series, heights: Callable, scale: tuple) -> None:
        """Show a distribution as the `at`-th, its counts mapped by `heights` and standing on the first of `scale`."""
        # During a run only the distribution now changes.
        if self._drawn is not None and self._drawn[0] is series.part and self._drawn[1:] == (at, scale):
            return
        self._drawn = (series.part, at, scale)
        floor, cumulative = scale[:2]
        colour = str(series.colour)
        part = series.part.cumulated() if cumulative else series.part
        filled = series.filled and not cumulative  # shares of all fill the whole plot and hide each other
        width = 1.0 if filled else 1.8
        pen = pg.mkPen(colour, width=width)
        brush = pg.mkBrush(colour + ("70" if series.current else "50")) if filled else None
        curve = heights(part, part.counts)
        self._curve.setData(
            np.linspace(0, 1, len(curve) + 1),
            curve,
            stepMode="center",
            pen=pen,
            fillLevel=floor if filled else None,
            brush=brush,
        )
        own = INVERTED if series.current else colour
        bars = [(part.axis.inverted, part.inverted)]
        _show_bars(self._bar, bars, part, heights, floor, pg.mkPen(own, width=width), filled and pg.mkBrush(own + "70"))
        ends = [(part.axis.below, part.below), (part.axis.above, part.above)]
        _show_bars(self._ends, ends, part, heights, floor, pen, brush)
        for item in self.items:
            item.setZValue(at)


def _show_bars(item: pg.BarGraphItem, bars: list, part: Distribution, heights: Callable, floor: float, pen, brush):
    bars = [(place, count) for place, count in bars if place is not None and count > 0]
    item.setVisible(bool(bars))
    if bars:
        item.setOpts(
            x0=[place[0] for place, _ in bars],
            x1=[place[1] for place, _ in bars],
            y0=[floor] * len(bars),
            height=[float(heights(part, count)) - floor for _, count in bars],
            pen=pen,
            brush=brush or pg.mkBrush(None),
        )
