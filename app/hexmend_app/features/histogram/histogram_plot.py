"""The plot of the histogram: distributions, inverted elements apart, and the brushed range."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import Distribution, decades, round_up
from hexmend_app.features.histogram.brush import BrushView
from hexmend_app.features.histogram.legend import HistogramLegend
from hexmend_app.features.histogram.outline import BROKEN, Heights, Outline, Series
from hexmend_app.theme.style import BLUE, INVERTED_TEXT, MUTED, on_theme_change, smaller, tabular
from hexmend_app.widgets.plots import calm_plot

#: The share of the plot that the legend and the numbers on bars may take from the bars.
_MAX_SPACE = 0.45


class HistogramPlot(QWidget):
    """Draws distributions; knows nothing of what they are of.

    The axis of counts is that of the bins; a bar beside them that is taller is broken, and carries its number.

    Parameters
    ----------
    legend : HistogramLegend
        Lies over the plot, in the room that is left above the bars.

    Attributes
    ----------
    plot : pyqtgraph.PlotWidget
    view : BrushView
        Announces what is brushed.
    heights : Heights
        Where counts lie.
    """

    def __init__(self, legend: HistogramLegend, parent: QWidget | None = None):
        super().__init__(parent)
        self.view = BrushView()
        self.plot = calm_plot(self.view)
        self.plot.setMinimumHeight(110)
        self.axis: Axis | None = None
        self.log = self.cumulative = False
        self.heights = Heights()
        self._least: float | None = None
        self.outlines: dict[str, Outline] = {}
        self._shown: Sequence[Series] = ()
        self._rows = 1  # of numbers on a bar
        self._regions = [pg.LinearRegionItem((0, 1), movable=False) for _ in range(2)]
        for region in self._regions:
            region.setZValue(-10)
            region.hide()
            self.plot.addItem(region, ignoreBounds=True)
        self.numbers = {key: [pg.TextItem() for _ in range(3)] for key in ("now", "start")}
        for number in (number for numbers in self.numbers.values() for number in numbers):
            number.setFont(tabular(smaller(self.font())))
            number.setZValue(100)
            self.plot.addItem(number, ignoreBounds=True)
        self.plot.getAxis("left").label.setFont(smaller(self.font()))
        # Its title is the legend's first word, for the sake of the plot's height.
        self.plot.getAxis("bottom").setHeight(self.fontMetrics().height() + 6)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.plot)
        self._legend = legend
        legend.setParent(self)
        legend.installEventFilter(self)
        self.view.sigResized.connect(self._reserve_space)
        on_theme_change(self, self._paint)

    def _paint(self) -> None:
        for region in self._regions:
            region.setBrush(f"{BLUE}20")
            for line in region.lines:
                line.setPen(str(BLUE), width=1.5)
        self.plot.getAxis("bottom").colours["inverted"] = INVERTED_TEXT
        for key, colour in (("now", INVERTED_TEXT), ("start", MUTED)):
            for number in self.numbers[key]:
                number.setColor(str(colour))
        for outline in self.outlines.values():
            outline.forget()
        self.draw(self._shown)

    def set_axis(self, axis: Axis) -> None:
        """Take the values that the bins span."""
        self.axis = axis
        self.view.reach = axis.reach
        self.plot.setXRange(*axis.extent, padding=0)
        self.plot.getAxis("bottom").setTicks([axis.ticks()])
        self._legend.set_title(axis.title)

    def draw(self, drawn: Sequence[Series]) -> None:
        """Draw distributions, the first at the bottom."""
        self._shown = drawn
        self._fit_counts([one.part for one in drawn])
        for key in self.outlines.keys() - {one.key for one in drawn}:
            for item in self.outlines.pop(key).items:
                self.plot.removeItem(item)
        for at, one in enumerate(drawn):
            if one.key not in self.outlines:
                self.outlines[one.key] = Outline()
                for item in self.outlines[one.key].items:
                    self.plot.addItem(item, ignoreBounds=True)
            self.outlines[one.key].draw(at, one, self.heights)
        now = next((one for one in drawn if one.current), None)
        self.view.bar = self.axis.inverted if now is not None and now.part.inverted else None
        self._write_numbers({one.key: one.part for one in drawn})

    def _write_numbers(self, parts: dict[str, Distribution]) -> None:
        """On every broken bar its number, that of now below that of the start; on that of the inverted now always."""
        rows = 1
        for at, name in enumerate(("inverted", "below", "above")):
            place, reported = self.axis and getattr(self.axis, name), None
            for key, numbers in self.numbers.items():
                number, part = numbers[at], parts.get(key)
                number.setVisible(part is not None and place is not None)
                if not number.isVisible():
                    continue
                count = getattr(part, name)
                top, broken = self.heights.bar(part, count)
                number.setVisible((broken and count != reported) or (key, name) == ("now", "inverted"))
                share = f"{100 * count / max(part.total, 1):.3g} %"
                number.setText(share if self.cumulative else f"{count:,}")
                number.setAnchor((0.5, 1.0 if reported is None else 1.7))
                number.setPos(QPointF(sum(place) / 2, top))
                if broken and number.isVisible():
                    rows, reported = max(rows, 1 if reported is None else 2), count
        if rows != self._rows:
            self._rows = rows
            self._reserve_space()

    def show_range(self, ends: tuple[float, float] | None, inverted: bool = False) -> None:
        """Show what is brushed, by its places on the plot, and whether it takes the bar of the inverted in."""
        self.view.range = ends
        bar = self.axis.inverted
        special = inverted and ends is not None and ends[0] > bar[1]
        for region, places in zip(self._regions, (ends, bar if special else None), strict=True):
            region.setVisible(places is not None)
            region.setRegion(places or (0.0, 1.0))

    # The axis of counts

    def _fit_counts(self, parts: Sequence[Distribution]) -> None:
        """Let the axis grow with the counts in the bins, and shrink only when they need less than half of it."""
        if self.cumulative:
            most, least = 100.0, min((100 / max(part.total, 1) for part in parts), default=1.0)
        else:
            most, least = max((int(part.counts.max()) for part in parts), default=1), 1.0
        same = (self.heights.log, self.heights.cumulative, self._least) == (self.log, self.cumulative, least)
        if same:
            before = 10.0**self.heights.top if self.log else self.heights.top
            if before / 2 <= max(most, 1) <= before * (1 + 1e-9):
                return
        self._least = least
        top = most if self.cumulative else round_up(most)
        if self.log:
            # An axis of one decade at least.
            self.heights = Heights(math.log10(0.5 * least), max(math.log10(top), 1.0), True, self.cumulative)
        else:
            self.heights = Heights(0.0, top, False, self.cumulative)
        self._show_counts(least)

    def _show_counts(self, least: float) -> None:
        left, high = self.plot.getAxis("left"), self.heights.top
        if self.log:
            first = 10.0 ** math.ceil(math.log10(least) - 1e-9)
            ticks = [(math.log10(first * n), f"{first * n:,g}") for n in decades(10.0**high / first)]
            if len(ticks) > 5:
                ticks = ticks[:: -(-len(ticks) // 5)]
        else:
            ticks = [(n, f"{n:,.0f}") for n in np.linspace(0, high, 5) if n == round(n)]
        left.setTicks([ticks])
        left.setLabel("% of hexes" if self.cumulative else "hexes")
        left.resizeEvent()  # where the text is centred; pyqtgraph thinks of it only as the plot is resized
        widest = max((self.fontMetrics().horizontalAdvance(text) for _, text in ticks), default=0)
        left.setWidth(max(widest, self.fontMetrics().horizontalAdvance("00,000")) + 26)
        self._reserve_space()

    # What stands above the bars

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Give the legend its room when what it names is another."""
        if event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.FontChange):
            self._reserve_space()
        return super().eventFilter(watched, event)

    def _reserve_space(self) -> None:
        """Lay the legend over the plot at the right, and end the bars below it."""
        space = self.view.sceneBoundingRect()
        if self.axis is None or space.width() < 1:
            return
        left, right = self.axis.extent
        bar_end = space.left() + space.width() * (self.axis.inverted[1] - left) / (right - left)
        size = self._legend.size_within(round(space.right() - bar_end) - 8)
        self._legend.setGeometry(round(space.right()) - size.width(), round(space.top()), size.width(), size.height())
        self._legend.raise_()
        numbers = (0.3 + 0.7 * self._rows) * self.numbers["now"][0].boundingRect().height()
        share = min(max(size.height(), numbers) / max(space.height(), 1), _MAX_SPACE)
        low = self.heights.floor
        self.plot.setYRange(low, low + (self.heights.share(BROKEN) - low) / (1 - share), padding=0)
