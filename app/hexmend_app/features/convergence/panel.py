"""Convergence panel: charts of the runs' figures below one another, and their settings."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QPointF, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QToolTip, QVBoxLayout, QWidget

from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.convergence_plot import ConvergencePlot
from hexmend_app.features.convergence.curves import Curve
from hexmend_app.features.convergence.head import ConvergenceHead
from hexmend_app.features.convergence.point_texts import describe
from hexmend_app.features.convergence.run_legend import RunLegend
from hexmend_app.scene.colour.ticks import nice_ticks
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.style import note
from hexmend_app.widgets.scrolled import scrolled

_NONE = "No method has run on this mesh yet. Its figures will appear here, iteration by iteration."

#: Width of what stands beside the charts, and of the whole from which on it does so.
_SIDE, _WIDE = 158, 420

# Qt's QWIDGETSIZE_MAX, which PySide6 does not hand on.
_UNBOUNDED = (1 << 24) - 1


class ConvergencePanel(QWidget):
    """Plots runs.

    Attributes
    ----------
    head : ConvergenceHead
    legend : RunLegend
    side, plotting : QWidget
        What has these two, and what plots the runs.

    Signals
    -------
    picked(Record, number)
        The user wants to go to an iteration.
    toggled(Record, bool), forget_requested(Record)
        The user wants a run plotted or not, or forgotten.
    choice_changed
        The user wants it plotted otherwise.
    save_requested
        The user wants the charts as a file.
    """

    picked = Signal(object, int)
    toggled = Signal(object, bool)
    forget_requested = Signal(object)
    choice_changed = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.curves: Sequence[Curve] = ()
        self._foot: tuple = ()
        self._shown: tuple[RunRecord, int] | None = None
        self.plots = {key: ConvergencePlot(chart) for key, chart in CHARTS.items()}
        for plot in self.plots.values():
            plot.picked.connect(self.picked)
            plot.hovered.connect(partial(self._on_hovered, plot))
        self.head, self.legend = ConvergenceHead(), RunLegend()
        self.head.charts_changed.connect(self._arrange)
        self.head.axes_changed.connect(self._redraw)
        self.head.from_zero_changed.connect(self.choice_changed)
        self.head.save_requested.connect(self.save_requested)
        self.legend.toggled.connect(self.toggled)
        self.legend.forget_requested.connect(self.forget_requested)
        self._lay_out()
        self._arrange()
        self.set_curves(())

    def _lay_out(self) -> None:
        stack = QWidget()
        charts = QVBoxLayout(stack)
        charts.setContentsMargins(0, 0, 0, 0)
        charts.setSpacing(2)
        for plot in self.plots.values():
            charts.addWidget(plot, 1)
        self._none = note(_NONE)
        self._none.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.plotting, self._runs = scrolled(stack), scrolled(self.legend)
        side = QVBoxLayout()
        side.setContentsMargins(0, 0, 0, 0)
        side.addWidget(self.head)
        side.addWidget(self._runs, 1)
        self.side = QWidget()
        self.side.setLayout(side)
        self._layout = QBoxLayout(QBoxLayout.Direction.RightToLeft, self)
        self._layout.setContentsMargins(6, 4, 6, 4)
        for part, stretch in ((self.side, 0), (self.plotting, 1), (self._none, 1)):
            self._layout.addWidget(part, stretch)

    def minimumSizeHint(self) -> QSize:
        """Return the fixed minimum size, wide enough for the buttons in one row."""
        return QSize(_SIDE + 120, 150)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put the runs beside the charts, or above them where that leaves too little room."""
        super().resizeEvent(event)
        self._place()

    def _place(self) -> None:
        neighbour = self.width() >= _WIDE
        directions = QBoxLayout.Direction
        self._layout.setDirection(directions.RightToLeft if neighbour else directions.TopToBottom)
        self.head.set_in_a_row(not neighbour)
        self.side.setMinimumWidth(_SIDE if neighbour else 0)
        self.side.setMaximumWidth(_SIDE if neighbour else _UNBOUNDED)
        row = self.fontMetrics().height() + 3
        self._runs.setMaximumHeight(_UNBOUNDED if neighbour else min(2, len(self.curves)) * row)

    # What is plotted

    @property
    def by_time(self) -> bool:
        """Return True if the axis shows seconds."""
        return self.head.by_time

    @property
    def drawn(self) -> list[ConvergencePlot]:
        """The charts that are chosen, in their order."""
        return [plot for key, plot in self.plots.items() if self.head.charts[key].isChecked()]

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """Plot these runs, the oldest first."""
        self.curves = curves
        self.legend.set_curves(curves)
        self.head.save.setEnabled(bool(curves))
        self._none.setVisible(not curves)
        self.plotting.setVisible(bool(curves))
        self._place()
        self._redraw()

    def set_shown(self, record: RunRecord | None, number: int = 0) -> None:
        """Mark the iteration that the view shows; None where that is none."""
        self._shown = None if record is None else (record, number)
        self._mark()

    def _arrange(self) -> None:
        drawn = self.drawn
        for plot in self.plots.values():
            plot.setVisible(plot in drawn)
        self._foot = ()
        self._redraw()

    def _redraw(self) -> None:
        self._fit()
        for plot in self.drawn:
            plot.draw(self.curves, self.by_time, self.head.log.isChecked())
        self._mark()

    def _fit(self) -> None:
        """Let the axis reach as far as the runs; while one goes on, in steps, so that it seldom changes."""
        places = [curve.x(self.by_time) for curve in self.curves if curve.shown and len(curve.columns)]
        low = min((float(x[0]) for x in places), default=0.0)
        high = max((float(x[-1]) for x in places), default=1.0)
        high = max(high, low + (1e-3 if self.by_time else 1.0))
        if any(curve.going for curve in self.curves):
            step = 10.0 ** len(f"{high - low:.0f}") / 20
            high = low + step * (1 + (high - low) // step)
        foot = (low, high, self.by_time)
        if foot == self._foot:
            return
        self._foot = foot
        spare = 0.012 * (high - low)
        ticks = [(tick, f"{tick:,.6g}") for tick in nice_ticks(low, high, 8) if self.by_time or tick == round(tick)]
        left = self.fontMetrics().horizontalAdvance("000,000")
        label = "seconds in the method" if self.by_time else "iteration"
        for plot in self.drawn:
            plot.set_span(low - spare, high + spare)
            plot.set_foot(label if plot is self.drawn[-1] else None, ticks, left)

    def _mark(self) -> None:
        found = None
        if self._shown is not None:
            record, number = self._shown
            curve = next((one for one in self.curves if one.record is record and one.shown), None)
            if curve is not None and number < len(curve.columns):
                found = float(curve.x(self.by_time)[number])
        for plot in self.drawn:
            plot.mark(found)

    # Under the mouse

    def _on_hovered(self, plot: ConvergencePlot, place: QPointF | None) -> None:
        text = ""
        if place is not None:
            text = describe(plot.chart, self.curves, plot.view.mapSceneToView(place).x(), self.by_time)
        at = plot.plot.mapToGlobal(plot.plot.mapFromScene(place)) if place is not None else plot.mapToGlobal(plot.pos())
        QToolTip.showText(at, text, plot.plot)
