"""The histogram of a metric, in which a range is brushed to look at its elements."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QToolTip, QVBoxLayout, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.announcer import Announcer
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bin_texts import describe, sentence
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.features.histogram.distributions import Distributions
from hexmend_app.features.histogram.head import HistogramHead
from hexmend_app.features.histogram.histogram_plot import HistogramPlot
from hexmend_app.features.histogram.legend import HistogramLegend
from hexmend_app.features.histogram.outline import Series
from hexmend_app.features.histogram.range import RangeRow
from hexmend_app.picture.appearance import ValueRange
from hexmend_app.theme.palette import KEPT
from hexmend_app.theme.style import MUTED, smaller, tabular, tint
from hexmend_app.widgets.eliding_label import ElidingLabel

#: Pixels that the words below the plot need beside the numbers.
_WORDS = 210
_HELP = (
    "How many hexes have which value. Inverted hexes stand apart at the left, whatever the metric. Drag over the "
    "plot to see only the hexes of a range; double-click to see all. A click on the bar of the "
    "inverted shows only them."
)


class QualityHistogram(QWidget):
    """Distribution of a metric at the start, now, and as it was kept, with a range of values to brush.

    Signals
    -------
    metric_chosen(str)
        The user chose a metric, or "", that of the colours.
    range_changed(ValueRange or None)
        The user brushed another range, or cleared it; at most thirty times a second.
    keep_requested
        The user wants to keep what is now.
    renamed(slot, name), removed(slot)
        The user calls what is kept otherwise, or keeps it no longer.
    save_requested
        The user wants the histogram as a file.
    inverted_requested
        The user clicked on the bar of the inverted elements of now, of which there are some.
    """

    metric_chosen = Signal(str)
    range_changed = Signal(object)
    keep_requested = Signal()
    renamed = Signal(int, str)
    removed = Signal(int)
    save_requested = Signal()
    inverted_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._distributions = Distributions()
        self._range: ValueRange | None = None
        self._announcer = Announcer(self)
        self._announcer.announced.connect(self.range_changed)
        self._make_parts()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(5, 3, 5, 3)
        layout.setSpacing(3)
        layout.addWidget(self.head)
        layout.addWidget(self.plot, 1)
        self._below = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._below.setSpacing(3)
        self._below.addWidget(self.ends)
        self._below.addWidget(self.words, 1)
        layout.addLayout(self._below)
        self._use_axis()
        self._refresh()

    def _make_parts(self) -> None:
        self.head, self.legend = HistogramHead(), HistogramLegend(_HELP)
        self.plot, self.ends = HistogramPlot(self.legend), RangeRow()
        self.head.metric_chosen.connect(self.metric_chosen)
        self.head.scale_changed.connect(self._on_scale)
        self.head.bins_changed.connect(self._on_bins)
        self.head.keep_requested.connect(self.keep_requested)
        self.head.save_requested.connect(self.save_requested)
        self.legend.renamed.connect(self.renamed)
        self.legend.removed.connect(self.removed)
        self.ends.chosen.connect(self._on_ends)
        self.ends.cleared.connect(lambda: self._choose(None))
        # Over the plot the tooltip says the counts; the legend above it explains.
        self.plot.plot.setAccessibleName("Histogram of hex quality")
        self.plot.plot.setAccessibleDescription(_HELP)
        self.plot.plot.setWhatsThis(_HELP)
        self.plot.view.brushed.connect(self._on_brushed)
        self.plot.view.cleared.connect(lambda: self._choose(None))
        self.plot.view.bar_clicked.connect(self.inverted_requested)
        self.plot.plot.scene().sigMouseMoved.connect(self._hover)
        # In one line, whatever it says: a second would push the plot about while a range is brushed.
        self.words = ElidingLabel()
        self.words.setFont(tabular(smaller(self.words.font())))
        self.words.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        tint(self.words, MUTED)
        self.words.setAccessibleName("Hexes shown")

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put the words below the numbers where there is no room beside them."""
        super().resizeEvent(event)
        neighbour = self.width() >= self.ends.minimumSizeHint().width() + _WORDS
        displacements, sides = QBoxLayout.Direction, Qt.AlignmentFlag
        self._below.setDirection(displacements.LeftToRight if neighbour else displacements.TopToBottom)
        self.words.setAlignment((sides.AlignRight if neighbour else sides.AlignLeft) | sides.AlignVCenter)

    # What is drawn

    def set_metric(self, name: str, as_colours: bool = False) -> None:
        """Draw another metric, of which `set_initial` and the others then bring the values.

        Parameters
        ----------
        name : str
            Of `hexmend.quality.METRICS`.
        as_colours : bool
            Whether it is the colours' that the histogram follows.
        """
        self.head.show_metric(name, as_colours)
        if name != self.axis.metric:
            self._distributions.begin(name)
            self.legend.set_kept([])
            self._refresh()
            self._use_axis()

    def set_initial(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Take the metric's values (m,) and (m,) bool of the elements at the start, which the axis is made for.

        Raises
        ------
        ValueError
            Where the two differ in shape.
        """
        before = self.axis
        self._distributions.set_initial(values, inverted)
        if self.axis != before:
            self._use_axis()
        self._refresh()

    def set_current(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Take values (m,) and (m,) bool of the elements now; raises as `set_initial`."""
        self._distributions.set_current(values, inverted)
        self._refresh()

    def set_kept(self, kept: Sequence[tuple[int, str, np.ndarray, np.ndarray]]) -> None:
        """Take slots, names, values (m,) and (m,) bool of what is kept."""
        self._distributions.set_kept(kept)
        self.legend.set_kept([(slot, name) for slot, name, _ in self._distributions.kept])
        self._refresh()

    def series(self) -> list[Series]:
        """Return the distributions drawn, in the order of the legend."""
        return self._distributions.series()

    @property
    def log(self) -> bool:
        """Return True if heights are logarithmic."""
        return self.plot.log

    @property
    def cumulative(self) -> bool:
        """Return True if heights are cumulative shares of elements."""
        return self.plot.cumulative

    @property
    def axis(self) -> Axis:
        """Return the range of values that the bins span."""
        return self._distributions.axis

    # The range

    def range(self) -> ValueRange | None:
        """The range shown; None for all."""
        return self._range

    def set_range(self, range: ValueRange | None) -> None:
        """Show a range of the histogram's metric, or all; without a signal.

        What was announced last and is now heard of again takes back nothing that was brushed since.
        """
        if self._announcer.hear(range):
            self._show_range(range if range is not None and range.metric == self.axis.metric else None)

    def _on_brushed(self, places: tuple[float, float]) -> None:
        cells = Cells(self.axis, self.head.bins.value())
        self._choose(cells.range(*cells.nearest(*places)))

    def _on_ends(self, low: float, high: float, inverted: bool) -> None:
        least, most = METRICS[self.axis.metric].full_range
        whole = low <= least and high >= most and inverted
        self._choose(None if whole else ValueRange(self.axis.metric, low, high, inverted))

    def _choose(self, chosen: ValueRange | None) -> None:
        if chosen != self._range:
            self._show_range(chosen)
            self._announcer.tell(chosen)

    def _show_range(self, chosen: ValueRange | None) -> None:
        self._range = chosen
        self.plot.show_range(chosen and self.axis.span(chosen), chosen is not None and chosen.inverted)
        self.ends.show_range(chosen)
        self._say()

    # Drawing

    def _use_axis(self) -> None:
        self.plot.set_axis(self.axis)
        self.ends.set_axis(self.axis)
        if self._range is not None and self._range.metric != self.axis.metric:
            self._range = None
            self._announcer.tell_instead(None)
        self._show_range(self._range)

    def _on_bins(self) -> None:
        self._distributions.divide(self.head.bins.value())
        self._refresh()

    def _on_scale(self) -> None:
        self.plot.log, self.plot.cumulative = self.head.log, self.head.cumulative.isChecked()
        self._refresh()

    def _refresh(self) -> None:
        self.head.set_offered(self._distributions.current is not None, len(self._distributions.kept) == len(KEPT))
        self.plot.draw(self.series())
        self._say()

    def _say(self) -> None:
        self.words.setText(sentence(self._distributions.current, self._range))
        self.words.setToolTip(self.words.text())

    # Under the mouse

    def describe_at(self, x: float) -> str:
        """The counts of the bin at x of the plot, or the shares up to it, of all that is drawn; "" beside the bins."""
        return describe(self.series(), x, self.cumulative)

    def _hover(self, at: QPointF) -> None:
        view, plot = self.plot.view, self.plot.plot
        inside = view.sceneBoundingRect().contains(at)
        text = self.describe_at(view.mapSceneToView(at).x()) if inside else ""
        QToolTip.showText(plot.mapToGlobal(plot.mapFromScene(at)), text, plot)
