"""The histogram of element quality, in which a range is brushed to look at its elements."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PySide6.QtCore import QPointF, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QLabel, QPushButton, QToolTip, QVBoxLayout, QWidget
from superqt.utils import QSignalThrottler

from hexmend.report.documents import write_text
from hexmend_app.widgets.histogram_bins import BINS, Distribution, distribute
from hexmend_app.widgets.histogram_plot import APART, EDGES, HistogramPlot
from hexmend_app.widgets.legend import legend_entry
from hexmend_app.widgets.segmented import Segmented
from hexmend_app.widgets.style import BLUE, GREY, explain, icon, note, smaller, tabular
from hexmend_app.widgets.wording import counted

_PERIOD_MS = 33
_HELP = (
    "How many elements have which quality q(H), the mean of the eight corner tetrahedra's 3 σ^⅔ / |S|² (2.10): 1 for a "
    "cube, 0 for a flat element. Inverted elements stand apart at the left. Drag over the plot to see only the "
    "elements of a range; double-click to see all."
)


class QualityHistogram(QWidget):
    """Distribution of q(H) at the start and now, with a range of q to brush.

    Signals
    -------
    range_changed((low, high) or None)
        The user brushed another range, or cleared it; at most thirty times a second.
    save_requested
        The user wants the histogram as a file.
    """

    range_changed = Signal(object)
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._initial: Distribution | None = None
        self._current: Distribution | None = None
        self._range: tuple[float, float] | None = None
        self._throttler = QSignalThrottler(parent=self)
        self._throttler.setTimeout(_PERIOD_MS)
        self._throttler.triggered.connect(lambda: self.range_changed.emit(self._range))
        self._plot = HistogramPlot()
        # Over the plot the tooltip says the counts; the legend above it explains.
        self._plot.plot.setAccessibleName("Histogram of element quality")
        self._plot.plot.setAccessibleDescription(_HELP)
        self._plot.plot.setWhatsThis(_HELP)
        self._plot.view.brushed.connect(self._choose)
        self._plot.view.cleared.connect(lambda: self._choose(None))
        self._plot.plot.scene().sigMouseMoved.connect(self._hover)
        layout = QVBoxLayout(self)
        layout.setSpacing(4)
        layout.addLayout(self._make_head())
        layout.addWidget(self._plot, 1)
        layout.addLayout(self._make_ends())
        self._text = note()
        self._text.setFont(tabular(self._text.font()))
        self._text.setWordWrap(False)  # a second line would push the view about while a range is brushed
        self._text.setAccessibleName("Elements shown")
        layout.addWidget(self._text)
        self._refresh()
        self._show_range(None)

    def _make_head(self) -> QHBoxLayout:
        self._scale = Segmented(
            "Scale of the counts",
            [
                ("linear", "Linear", "Heights in proportion to the number of elements."),
                ("log", "Log", "Heights by powers of ten, so that a few bad elements show beside many good ones."),
            ],
        )
        self._scale.setFont(smaller(self.font()))
        self._scale.chosen.connect(self._on_scale)
        head = QHBoxLayout()
        for text, colour in (("at the start", GREY), ("now", BLUE)):
            entry = legend_entry(text, colour)
            explain(entry, text, _HELP)
            head.addWidget(entry)
        head.addStretch()
        head.addWidget(self._scale)
        self._save = QPushButton(icon("content-save-outline"), "")
        explain(self._save, "Save histogram", "Save the histogram as SVG, PDF or PNG, or its counts as CSV.")
        self._save.clicked.connect(self.save_requested)
        head.addWidget(self._save)
        return head

    def _make_ends(self) -> QHBoxLayout:
        self._low, self._high = self._make_end("Lowest q shown", 0.0), self._make_end("Highest q shown", 1.0)
        self._all = QPushButton("Show all")
        explain(self._all, "Show all", "Show the elements of every quality again (or double-click on the plot).")
        self._all.clicked.connect(lambda: self._choose(None))
        ends = QHBoxLayout()
        for part in (QLabel("Show q from"), self._low, QLabel("to"), self._high):
            ends.addWidget(part)
        ends.addStretch()
        ends.addWidget(self._all)
        return ends

    def _make_end(self, name: str, value: float) -> QDoubleSpinBox:
        box = QDoubleSpinBox()
        box.setRange(0, 1)
        box.setSingleStep(0.01)
        box.setValue(value)
        # A half-typed number is not a wish.
        box.setKeyboardTracking(False)
        box.setAlignment(Qt.AlignmentFlag.AlignRight)
        box.setFont(tabular(box.font()))
        box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        explain(box, name, f"{name}: elements beyond it are hidden. Dragging over the plot sets the same range.")
        box.valueChanged.connect(self._on_ends)
        return box

    def set_initial(self, q: np.ndarray, inverted: np.ndarray) -> None:
        """Take the quality (m,) in [0, 1] and (m,) bool of the elements at the start.

        Raises
        ------
        ValueError
            Where the two differ in shape.
        """
        self._initial = distribute(q, inverted)
        self._refresh()

    def set_current(self, q: np.ndarray, inverted: np.ndarray) -> None:
        """Take the quality (m,) in [0, 1] and (m,) bool of the elements now; raises as `set_initial`."""
        self._current = distribute(q, inverted)
        self._refresh()

    def clear(self) -> None:
        """Show no distribution."""
        self._initial = self._current = None
        self._refresh()

    @property
    def log(self) -> bool:
        """Whether heights go by powers of ten."""
        return self._plot.log

    def distributions(self) -> dict[str, Distribution]:
        """What is drawn, by name."""
        known = {"at the start": self._initial, "now": self._current}
        return {name: one for name, one in known.items() if one is not None}

    def text(self) -> str:
        """The counts as CSV: a line a bin, the inverted elements first."""
        drawn = self.distributions()
        lines = [",".join(["from", "to", *drawn])]
        lines.append(",".join(["inverted", "inverted", *(str(one.inverted) for one in drawn.values())]))
        for at in range(BINS):
            counts = (str(int(one.counts[at])) for one in drawn.values())
            lines.append(",".join([f"{EDGES[at]:.2f}", f"{EDGES[at + 1]:.2f}", *counts]))
        return "\n".join(lines) + "\n"

    def range(self) -> tuple[float, float] | None:
        """The range shown; None for all."""
        return self._range

    def set_range(self, range: tuple[float, float] | None) -> None:
        """Show a range of q, or all; without a signal."""
        self._throttler.cancel()
        self._show_range(range)

    def describe_at(self, x: float) -> str:
        """The counts of the bin at x of the plot, then and now; "" beside the bins."""
        known = [(word, part) for word, part in (("at the start", self._initial), ("now", self._current)) if part]
        if known and APART[0] <= x <= APART[1]:
            title, numbers = "inverted", [(word, part.inverted) for word, part in known]
        elif known and 0 <= x < 1:
            at = int(x * BINS)
            title = f"q(H) {EDGES[at]:.2f} – {EDGES[at + 1]:.2f}"
            numbers = [(word, int(part.counts[at])) for word, part in known]
        else:
            return ""
        return "\n".join([title, *(f"{word}: {counted(number, 'element')}" for word, number in numbers)])

    def _choose(self, range: tuple[float, float] | None) -> None:
        if range != self._range:
            self._show_range(range)
            self._throttler.throttle()

    def _on_ends(self) -> None:
        low, high = sorted((round(self._low.value(), 2), round(self._high.value(), 2)))
        self._choose(None if (low, high) == (0, 1) else (low, high))

    def _on_scale(self, key: str) -> None:
        self._plot.set_log(key == "log")
        self._refresh()

    def _show_range(self, range: tuple[float, float] | None) -> None:
        self._range = range
        low, high = range or (0.0, 1.0)
        self._plot.show_range(range)
        with QSignalBlocker(self._low), QSignalBlocker(self._high):
            # Ends that were typed in the other order stay where the user typed them.
            if sorted((self._low.value(), self._high.value())) != [low, high]:
                self._low.setValue(low)
                self._high.setValue(high)
        self._all.setEnabled(range is not None)
        self._say()

    def _refresh(self) -> None:
        self._save.setEnabled(self._current is not None)
        self._plot.draw(self._initial, self._current)
        self._say()

    def _say(self) -> None:
        now = self._current
        if now is None:
            self._text.setText("No mesh is open.")
        elif self._range is None:
            self._text.setText(f"{counted(now.total, 'element')}, {now.inverted:,} of them inverted")
        else:
            low, high = self._range
            inside, inverted = now.within(low, high)
            also = f", {inverted:,} of them inverted" if inverted else ""
            self._text.setText(f"{inside:,} of {counted(now.total, 'element')} in {low:.2f} – {high:.2f}{also}")

    def _hover(self, at: QPointF) -> None:
        view, plot = self._plot.view, self._plot.plot
        inside = view.sceneBoundingRect().contains(at)
        text = self.describe_at(view.mapSceneToView(at).x()) if inside else ""
        QToolTip.showText(plot.mapToGlobal(plot.mapFromScene(at)), text, plot)


def write_histogram(path: Path, histogram: QualityHistogram, title: str) -> None:
    """Write a histogram as SVG, PDF or PNG, or its counts as CSV, by the path's suffix.

    Raises
    ------
    HexmendError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    if path.suffix.lower() == ".csv":
        write_text(path, histogram.text())
        return
    from hexmend.report.plots import write_distributions

    drawn = histogram.distributions()
    counts = {name: one.counts.tolist() for name, one in drawn.items()}
    inverted = {name: one.inverted for name, one in drawn.items()}
    write_distributions(path, counts, inverted, title, histogram.log)
