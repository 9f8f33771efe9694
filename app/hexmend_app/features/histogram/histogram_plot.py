"""Plot of the histogram: distributions with separate bars, and the brushed range."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, QPointF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.features.histogram.brush import BrushView, ColourRange
from hexmend_app.features.histogram.legend import HistogramLegend
from hexmend_app.features.histogram.outline import BROKEN_TOP, Heights, Outline, Series
from hexmend_app.scene.colour.ticks import nice_ticks
from hexmend_app.theme.palette import BLUE, INVERTED_TEXT, MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.plots import calm_plot, log_ticks

#: Maximum fraction of the plot's height for the legend and the numbers on bars.
_MAX_LEGEND = 0.45

#: Room above the tallest bin when the axis of counts is fitted, its smallest upper end, and its number of ticks.
_HEADROOM, _LEAST_TOP, _COUNT_TICKS = 1.25, 5.0, 6


class HistogramPlot(QWidget):
    """Plots distributions.

    The axis of counts fits the bins; a separate bar that is taller is broken and labelled with its count.

    Parameters
    ----------
    legend : HistogramLegend
        Is laid over the plot, above the bars.

    Attributes
    ----------
    plot : pyqtgraph.PlotWidget
    view : BrushView
        Announces brushed ranges.
    heights : Heights
        Axis of counts.
    colour_range : ColourRange
        Handles of the range of colours.
    """

    def __init__(self, legend: HistogramLegend, parent: QWidget | None = None):
        super().__init__(parent)
        self.view = BrushView()
        self.plot = calm_plot(self.view)
        self.plot.setMinimumHeight(110)
        self.axis: Axis | None = None
        self.log = self.cumulative = False
        self.heights = Heights()
        self._smallest: float | None = None
        self.outlines: dict[str, Outline] = {}
        self._series: Sequence[Series] = ()
        self._number_rows = 1  # on a bar
        self.colour_range = ColourRange(self.plot)
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
        self.plot.getAxis("bottom").setHeight(self.fontMetrics().height() + 6)  # its title is in the legend
        fill(QVBoxLayout(self), self.plot, margins=(0, 0, 0, 0))
        self._legend = legend
        legend.setParent(self)
        legend.installEventFilter(self)
        self.view.sigResized.connect(self._reserve_space)
        on_theme_change(self, self._paint)

    def _paint(self) -> None:
        self.colour_range.paint(str(MUTED), str(BLUE))
        for region in self._regions:
            region.setBrush(f"{BLUE}20")
            for line in region.lines:
                line.setPen(str(BLUE), width=1.5)
        self.plot.getAxis("bottom").colours[tr("inverted")] = INVERTED_TEXT
        for key, colour in (("now", INVERTED_TEXT), ("start", MUTED)):
            for number in self.numbers[key]:
                number.setColor(str(colour))
        for outline in self.outlines.values():
            outline.forget()
        self.draw(self._series)

    def set_axis(self, axis: Axis) -> None:
        """Change the axis of values."""
        self.axis = axis
        self.view.limits = axis.brush_limits
        self.plot.setXRange(*axis.extent, padding=0)
        self.plot.getAxis("bottom").setTicks([axis.ticks()])
        self._legend.set_title(axis.title)

    def draw(self, series: Sequence[Series]) -> None:
        """Draw distributions, the first at the bottom."""
        self._series = series
        self._fit_counts([one.distribution for one in series])
        for key in self.outlines.keys() - {one.key for one in series}:
            for item in self.outlines.pop(key).items:
                self.plot.removeItem(item)
        for index, one in enumerate(series):
            if one.key not in self.outlines:
                self.outlines[one.key] = Outline()
                for item in self.outlines[one.key].items:
                    self.plot.addItem(item, ignoreBounds=True)
            self.outlines[one.key].draw(index, one, self.heights)
        now = next((one.distribution for one in series if one.current), None)
        self.view.bar = self.axis.inverted if now is not None and now.inverted else None
        self._write_numbers({one.key: one.distribution for one in series})

    def _write_numbers(self, distributions: dict[str, Distribution]) -> None:
        """Label broken bars, with the count at the start above that of now, and always the bar of inverted hexes."""
        rows = 1
        for index, name in enumerate(("inverted", "below", "above")):
            span, labelled = getattr(self.axis, name, None), None
            for key, numbers in self.numbers.items():
                number, distribution = numbers[index], distributions.get(key)
                number.setVisible(distribution is not None and span is not None)
                if not number.isVisible():
                    continue
                count = getattr(distribution, name)
                top, broken = self.heights.bar(distribution, count)
                number.setVisible((broken and count != labelled) or (key, name) == ("now", "inverted"))
                share = f"{100 * count / max(distribution.total, 1):.3g} %"
                number.setText(share if self.cumulative else f"{count:,}")
                number.setAnchor((0.5, 1.0 if labelled is None else 1.7))
                number.setPos(QPointF(sum(span) / 2, top))
                if broken and number.isVisible():
                    rows, labelled = max(rows, 1 if labelled is None else 2), count
        if rows != self._number_rows:
            self._number_rows = rows
            self._reserve_space()

    def show_range(self, span: tuple[float, float] | None, inverted: bool = False) -> None:
        """Show the brushed range by its span on the plot, and the bar of inverted hexes if it is in the range."""
        self.view.range = span
        bar = self.axis.inverted
        separate = inverted and span is not None and span[0] > bar[1]
        for region, ends in zip(self._regions, (span, bar if separate else None), strict=True):
            region.setVisible(ends is not None)
            region.setRegion(ends or (0.0, 1.0))

    # Axis of counts

    def _fit_counts(self, distributions: Sequence[Distribution]) -> None:
        """Fit the axis to the bins: it grows with their counts, and shrinks only if they need less than half of it."""
        if self.cumulative:
            largest, smallest = 100.0, min((100 / max(one.total, 1) for one in distributions), default=1.0)
        else:
            largest, smallest = max((int(one.counts.max()) for one in distributions), default=1), 1.0
        if (self.heights.log, self.heights.cumulative, self._smallest) == (self.log, self.cumulative, smallest):
            before = 10.0**self.heights.top if self.log else self.heights.top
            if before / 2 <= max(largest, 1) <= before * (1 + 1e-9):
                return
        self._smallest = smallest
        top = largest if self.cumulative else max(_HEADROOM * largest, _LEAST_TOP)
        if self.log:
            self.heights = Heights(math.log10(0.5 * smallest), math.log10(top), True, self.cumulative)
        else:
            self.heights = Heights(0.0, top, False, self.cumulative)
        self._show_counts(smallest)

    def _show_counts(self, smallest: float) -> None:
        left, high = self.plot.getAxis("left"), self.heights.top
        ticks = log_ticks(math.ceil(math.log10(smallest) - 1e-9), high) if self.log else count_ticks(high)
        left.setTicks([ticks])
        left.setLabel(tr("% of hexes") if self.cumulative else tr("hexes"))
        left.resizeEvent()  # centres the label, which pyqtgraph does only when the plot is resized
        widest = max((self.fontMetrics().horizontalAdvance(text) for _, text in ticks), default=0)
        left.setWidth(max(widest, self.fontMetrics().horizontalAdvance("00,000")) + 26)
        self._reserve_space()

    # Space above the bars

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Reserve space for the legend again when its entries change."""
        if event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.FontChange):
            self._reserve_space()
        return super().eventFilter(watched, event)

    def _reserve_space(self) -> None:
        """Place the legend at the top right of the plot, and scale the plot so that the bars end below it."""
        space = self.view.sceneBoundingRect()
        if self.axis is None or space.width() < 1:
            return
        left, right = self.axis.extent
        bar_end = space.left() + space.width() * (self.axis.inverted[1] - left) / (right - left)
        size = self._legend.size_within(round(space.right() - bar_end) - 8)
        self._legend.setGeometry(round(space.right()) - size.width(), round(space.top()), size.width(), size.height())
        self._legend.raise_()
        numbers = (0.3 + 0.7 * self._number_rows) * self.numbers["now"][0].boundingRect().height()
        fraction = min(max(size.height(), numbers) / max(space.height(), 1), _MAX_LEGEND)
        self.colour_range.end_at(1 - fraction)
        low = self.heights.floor
        self.plot.setYRange(low, low + (self.heights.at_fraction(BROKEN_TOP) - low) / (1 - fraction), padding=0)


def count_ticks(top: float) -> list[tuple[float, str]]:
    """Return ticks from 0 to the top of an axis of counts, with their texts: whole numbers only.

    >>> count_ticks(13.0)
    [(0.0, '0'), (5.0, '5'), (10.0, '10')]
    """
    return [(tick, f"{tick:,.0f}") for tick in nice_ticks(0, top, _COUNT_TICKS) if tick == round(tick)]
