"""Panel of the histogram, in which a range of values is brushed to show only its hexes."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QToolTip, QVBoxLayout, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bin_texts import describe_bin, range_summary
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.features.histogram.distributions import Distributions
from hexmend_app.features.histogram.head import HistogramHead
from hexmend_app.features.histogram.histogram_plot import HistogramPlot
from hexmend_app.features.histogram.legend import HistogramLegend
from hexmend_app.features.histogram.outline import Gradient, Series
from hexmend_app.features.histogram.range_row import RangeRow
from hexmend_app.picture.visibility import Show
from hexmend_app.theme.palette import KEPT, MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel

#: Width of the summary next to the range of numbers, in pixels.
_SUMMARY_WIDTH = 210
_HELP = (
    "Number of hexes by value. Inverted hexes have a separate bar at the left, for every metric. Drag over the plot "
    "to show only the hexes of a range, or click a bar to show only its hexes; double-click to show all hexes. The two "
    "dashed lines are the ends of the range of colours: drag them."
)


class QualityHistogram(QWidget):
    """Distribution of a metric at the start, now and of snapshots, in which a range can be brushed.

    Signals
    -------
    range_changed(Show or None)
        The user brushed or typed a range, or cleared it.
    inverted_requested
        The user clicked the bar of inverted hexes, which is not empty.
    colours_dragged(low, high)
        The user dragged an end of the range of colours to these values.
    """

    range_changed = Signal(object)
    inverted_requested = Signal()
    colours_dragged = Signal(float, float)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._distributions = Distributions()
        self._range: Show | None = None
        self._colour_ends = (0.0, 1.0)
        self._make_widgets()
        self._bottom = fill(QBoxLayout(QBoxLayout.Direction.LeftToRight), self.range_row, (self.summary, 1), spacing=4)
        fill(QVBoxLayout(self), self.head, (self.plot, 1), self._bottom, margins=(4, 4, 4, 4), spacing=4)
        self._use_axis()
        self._refresh()

    def _make_widgets(self) -> None:
        self.head, self.legend = HistogramHead(), HistogramLegend(tr(_HELP))
        self.plot, self.range_row = HistogramPlot(self.legend), RangeRow()
        self.head.scale_changed.connect(self._on_scale)
        self.head.bins.valueChanged.connect(self._on_bins)
        self.range_row.chosen.connect(self._on_typed)
        self.range_row.all.clicked.connect(lambda: self._choose(None))
        # The tooltip of the plot shows counts; the help is the tooltip of the legend.
        self.plot.plot.setAccessibleName(tr("Histogram of hex quality"))
        self.plot.plot.setAccessibleDescription(tr(_HELP))
        self.plot.plot.setWhatsThis(tr(_HELP))
        self.plot.view.brushed.connect(self._on_brushed)
        self.plot.view.cleared.connect(lambda: self._choose(None))
        self.plot.view.bar_clicked.connect(self.inverted_requested)
        self.plot.view.clicked.connect(self._on_clicked)
        self.plot.colour_range.dragged.connect(self._on_colours)
        self.plot.plot.scene().sigMouseMoved.connect(self._hover)
        self.summary = ElidingLabel()  # one line: a second line would move the plot while a range is brushed
        self.summary.setFont(tabular(smaller(self.summary.font())))
        self.summary.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        tint(self.summary, MUTED)
        self.summary.setAccessibleName(tr("Hexes shown"))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the summary right of the range of numbers, or below if the panel is too narrow."""
        super().resizeEvent(event)
        wide = self.width() >= self.range_row.minimumSizeHint().width() + _SUMMARY_WIDTH
        direction, alignment = QBoxLayout.Direction, Qt.AlignmentFlag
        self._bottom.setDirection(direction.LeftToRight if wide else direction.TopToBottom)
        self.summary.setAlignment((alignment.AlignRight if wide else alignment.AlignLeft) | alignment.AlignVCenter)

    # Distributions

    def set_metric(self, name: str, as_colours: bool = False) -> None:
        """Change the metric; if it is another one, all distributions are removed.

        Parameters
        ----------
        name : str
            A name of `hexmend.quality.METRICS`.
        as_colours : bool
            True if the histogram follows the metric of the colours.
        """
        self.head.show_metric(name, as_colours)
        if name != self.axis.metric:
            self._distributions.reset(name)
            self.legend.set_snapshots([])
            self._refresh()
            self._use_axis()

    def set_initial(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Set the distribution at the start, and fit the axis to it.

        Parameters
        ----------
        values : (m,) float64
            Values of the metric.
        inverted : (m,) bool

        Raises
        ------
        ValueError
            If the arrays differ in shape.
        """
        before = self.axis
        self._distributions.set_initial(values, inverted)
        if self.axis != before:
            self._use_axis()
        self._refresh()

    def set_current(self, values: np.ndarray, inverted: np.ndarray, inside: int = 0) -> None:
        """Set the distribution of now, and the number of hexes that are invalid inside; see `set_initial`."""
        self._distributions.set_current(values, inverted, inside)
        self._refresh()

    def set_snapshots(self, snapshots: Sequence[tuple[int, str, np.ndarray, np.ndarray]]) -> None:
        """Set the distributions of snapshots, given as (slot, name, values, inverted); see `set_initial`."""
        self._distributions.set_snapshots(snapshots)
        self.legend.set_snapshots([(slot, name) for slot, name, _ in self._distributions.snapshots])
        self._refresh()

    def set_gradient(self, gradient: Gradient) -> None:
        """Fill the distribution of now with colours along the axis; with that of its name for ()."""
        if gradient != self._distributions.gradient:
            self._distributions.gradient = gradient
            self._refresh()

    def set_colour_range(self, ends: tuple[float, float] | None) -> None:
        """Show the values at both ends of the range of colours; None if the colours show another metric."""
        if ends is not None:
            self._colour_ends = ends
            low, width = self.axis.low, self.axis.high - self.axis.low
            ends = ((ends[0] - low) / width, (ends[1] - low) / width)
        self.plot.colour_range.show_ends(ends)

    def series(self) -> list[Series]:
        """Return the distributions as they are drawn, in the order of the legend."""
        return self._distributions.series()

    @property
    def log(self) -> bool:
        """True if heights are logarithmic."""
        return self.plot.log

    @property
    def cumulative(self) -> bool:
        """True if heights are cumulative shares of hexes."""
        return self.plot.cumulative

    @property
    def axis(self) -> Axis:
        """Axis of values."""
        return self._distributions.axis

    # Range

    def range(self) -> Show | None:
        """Return the range of the hexes shown; None for all hexes."""
        return self._range

    def set_range(self, range: Show | None) -> None:
        """Show a range of the histogram's metric, or None for all hexes, without emitting a signal."""
        self._show_range(range if range is not None and range.metric == self.axis.metric else None)

    def _on_brushed(self, span: tuple[float, float]) -> None:
        cells = Cells(self.axis, self.head.bins.value())
        self._choose(cells.range(*cells.nearest(*span)))

    def _on_clicked(self, x: float, y: float) -> None:
        """Show only the hexes of the bar at a position of the plot."""
        current = self._distributions.current
        if current is None or self.cumulative:
            return
        cell = current.cells.at(x)
        if cell is not None and current.in_cell(cell) and y <= self.plot.heights.bar(current, current.in_cell(cell))[0]:
            self._choose(current.cells.range(cell, cell))

    def _on_colours(self, end: int, position: float) -> None:
        """Announce the range of colours with one end at a position of the plot, rounded to a thousandth of the axis."""
        ends, width = list(self._colour_ends), self.axis.high - self.axis.low
        ends[end] = round(self.axis.low + position * width, 3 - math.floor(math.log10(width)))
        self._colour_ends = (ends[0], ends[1])
        self.colours_dragged.emit(*ends)

    def _on_typed(self, low: float, high: float, inverted: bool) -> None:
        minimum, maximum = METRICS[self.axis.metric].full_range
        unbounded = low <= minimum and high >= maximum and inverted
        self._choose(None if unbounded else Show((low, high), self.axis.metric, inverted))

    def _choose(self, range: Show | None) -> None:
        if range != self._range:
            self._show_range(range)
            self.range_changed.emit(range)

    def _show_range(self, range: Show | None) -> None:
        self._range = range
        self.plot.show_range(None if range is None else self.axis.span(range), range is not None and range.inverted)
        self.range_row.show_range(range)
        self._show_summary()

    # Drawing

    def _use_axis(self) -> None:
        self.plot.set_axis(self.axis)
        self.range_row.set_axis(self.axis)
        if self._range is not None and self._range.metric != self.axis.metric:
            self._range = None
        self._show_range(self._range)

    def _on_bins(self) -> None:
        self._distributions.set_bins(self.head.bins.value())
        self._refresh()

    def _on_scale(self) -> None:
        self.plot.log, self.plot.cumulative = self.head.log, self.head.cumulative.isChecked()
        self._refresh()

    def _refresh(self) -> None:
        full = len(self._distributions.snapshots) == len(KEPT)
        self.head.set_available(self._distributions.current is not None, full)
        self.plot.draw(self.series())
        self._show_summary()

    def _show_summary(self) -> None:
        self.summary.setText(range_summary(self._distributions.current, self._range, self._distributions.inside))
        self.summary.setToolTip(self.summary.text())

    # Tooltip

    def describe_at(self, x: float) -> str:
        """Describe the bin at a position of the plot; see `describe_bin`."""
        return describe_bin(self.series(), x, self.cumulative)

    def _hover(self, position: QPointF) -> None:
        view, plot = self.plot.view, self.plot.plot
        inside = view.sceneBoundingRect().contains(position)
        text = self.describe_at(view.mapSceneToView(position).x()) if inside else ""
        QToolTip.showText(plot.mapToGlobal(plot.mapFromScene(position)), text, plot)
