"""A small live chart of a run: quality and inverted elements against the iteration."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from hexmend_app.widgets.histogram_bins import round_up
from hexmend_app.widgets.legend import legend_entry
from hexmend_app.widgets.plots import calm_plot
from hexmend_app.widgets.style import BLUE, INVERTED, WORSE, dress, explain, smaller

_MIN, _MEAN = WORSE, BLUE
_HELP = (
    "How the run gets on: quality of the worst element (q min) and on average (q mean) above, 1 for cubes; the number "
    "of inverted elements below, in proportion to the most there have been."
)


class ProgressChart(QWidget):
    """Draws q_min, q_mean and the number of inverted elements; points are added as the run goes."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._rows: list[tuple[int, float, float, int]] = []
        self._quality, self._inverted = calm_plot(), calm_plot()
        self._lines = {
            "min": self._quality.plot(),
            "mean": self._quality.plot(),
            "inverted": self._inverted.plot(
                pen=pg.mkPen(INVERTED), fillLevel=0, brush=pg.mkBrush(INVERTED + "50"), stepMode="right"
            ),
        }
        self._quality.setYRange(0, 1.08, padding=0.02)  # room for half of the topmost figure
        self._quality.getAxis("left").setTicks([[(0, "0"), (0.5, "0.5"), (1, "1")]])
        self._quality.getAxis("bottom").setStyle(showValues=False)
        self._inverted.getAxis("bottom").setLabel("iteration")
        self._inverted.getAxis("bottom").label.setFont(smaller(self.font()))
        self._quality.setFixedHeight(90)
        self._inverted.setFixedHeight(44 + 2 * self.fontMetrics().height())
        self._inverted.getAxis("bottom").setHeight(2 * self.fontMetrics().height() + 6)
        self._inverted.setXLink(self._quality)
        for plot in (self._quality, self._inverted):
            plot.getAxis("left").setWidth(self.fontMetrics().horizontalAdvance("00,000") + 10)
            explain(plot, "Progress of the run", _HELP)
        layout = QVBoxLayout(self)
        layout.setSpacing(2)
        head = QHBoxLayout()
        for text, colour in (("q min", _MIN), ("q mean", _MEAN), ("inverted", INVERTED)):
            entry = legend_entry(text, colour)
            explain(entry, text, _HELP)
            head.addWidget(entry)
        head.addStretch()
        layout.addLayout(head)
        layout.addWidget(self._quality)
        layout.addWidget(self._inverted)
        self._draw()
        dress(self, self._paint)

    def _paint(self) -> None:
        for name, colour in (("min", _MIN), ("mean", _MEAN)):
            self._lines[name].setPen(pg.mkPen(str(colour), width=1.5))

    def clear(self) -> None:
        """Begin a new run."""
        self._rows = []
        self._draw()

    def add(self, iteration: int, q_min: float, q_mean: float, inverted: int) -> None:
        """Add an iteration."""
        self._rows.append((int(iteration), float(q_min), float(q_mean), int(inverted)))
        self._draw()

    def rows(self) -> np.ndarray:
        """(k, 4) float64: iteration, q_min, q_mean, inverted, as drawn."""
        return np.array(self._rows, dtype=np.float64).reshape(-1, 4)

    def _draw(self) -> None:
        rows = self.rows()
        at = rows[:, 0]
        for column, line in enumerate(self._lines.values(), start=1):
            line.setData(at, rows[:, column])
        first, last = (at[0], at[-1]) if len(at) else (0, 0)
        self._quality.setXRange(first, max(last, first + 1), padding=0.01)
        top = round_up(rows[:, 3].max() if len(at) else 1)
        # Room for half of the topmost figure.
        self._inverted.setYRange(0, 1.2 * top, padding=0.02)
        self._inverted.getAxis("left").setTicks([[(0, "0"), (top, f"{top:,.4g}")]])
