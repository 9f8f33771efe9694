"""Panel of convergence charts, stacked or in a row, with their settings and the list of runs."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QVBoxLayout, QWidget

from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.convergence_plot import ConvergencePlot
from hexmend_app.features.convergence.curves import Curve, axis_title
from hexmend_app.features.convergence.head import ConvergenceHead
from hexmend_app.features.convergence.run_list import RunList
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note
from hexmend_app.translation import tr
from hexmend_app.widgets.form import scrolled

_EMPTY = "No runs yet. Values of each iteration will appear here."

#: Width of the controls next to the charts, their height above them, and smallest width of a panel with the controls
#: at the side, in pixels.
_SIDE, _ABOVE, _WIDE = 158, 90, 420

#: Charts lower than this are in a row instead of stacked, in pixels.
_LOW_CHART = 130

#: Smallest number of iterations on the axis, so that its ticks are whole.
_LEAST_ITERATIONS = 5.0

# Qt's QWIDGETSIZE_MAX, which PySide6 does not export.
_UNBOUNDED = (1 << 24) - 1


class ConvergencePanel(QWidget):
    """Panel that plots runs.

    Attributes
    ----------
    head : ConvergenceHead
    runs : RunList
    side, plotting : QWidget
        Parents of the controls and of the charts.

    Signals
    -------
    picked(RunRecord, number)
        The user selected an iteration.
    """

    picked = Signal(object, int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.curves: Sequence[Curve] = ()
        self._shown: tuple[RunRecord, int] | None = None
        self.plots = {key: ConvergencePlot(chart) for key, chart in CHARTS.items()}
        for plot in self.plots.values():
            plot.picked.connect(self.picked)
        self.head, self.runs = ConvergenceHead(), RunList()
        self.head.changed.connect(self._redraw)
        self._lay_out()
        self.set_curves(())

    def _lay_out(self) -> None:
        stack, self.side = QWidget(), QWidget()
        self._charts = QBoxLayout(QBoxLayout.Direction.TopToBottom, stack)
        fill(self._charts, *((plot, 1) for plot in self.plots.values()), margins=(0, 0, 0, 0), spacing=4)
        self._empty = note(tr(_EMPTY))
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.plotting = scrolled(stack)
        fill(QVBoxLayout(self.side), self.head, (self.runs, 1), margins=(0, 0, 0, 0))
        self._layout = QBoxLayout(QBoxLayout.Direction.RightToLeft, self)
        fill(self._layout, self.side, (self.plotting, 1), (self._empty, 1), margins=(8, 4, 8, 4))

    def minimumSizeHint(self) -> QSize:
        """Return the fixed minimum size, wide enough for the buttons in one row."""
        return QSize(_SIDE + 120, 150)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the controls next to the charts, or above them in a narrow panel; put low charts in a row."""
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        directions, wide = QBoxLayout.Direction, self.width() >= _WIDE
        self._layout.setDirection(directions.RightToLeft if wide else directions.TopToBottom)
        self.side.setMinimumWidth(_SIDE if wide else 0)
        self.side.setMaximumSize(_SIDE if wide else _UNBOUNDED, _UNBOUNDED if wide else _ABOVE)
        in_row = wide and self.height() < len(self.drawn) * _LOW_CHART
        self._charts.setDirection(directions.LeftToRight if in_row else directions.TopToBottom)

    # Curves

    @property
    def by_time(self) -> bool:
        """Return True if the axis shows seconds."""
        return self.head.by_time.isChecked()

    @property
    def drawn(self) -> list[ConvergencePlot]:
        """The selected charts, from top to bottom."""
        return [plot for key, plot in self.plots.items() if self.head.charts[key].isChecked()]

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """Plot runs, the oldest first."""
        self.curves = curves
        self.runs.set_curves(curves)
        self.head.save.setEnabled(bool(curves))
        self._empty.setVisible(not curves)
        self.plotting.setVisible(bool(curves))
        self._redraw()

    def set_shown(self, record: RunRecord | None, number: int = 0) -> None:
        """Mark the iteration shown in the view; None for no mark."""
        self._shown = None if record is None else (record, number)
        self._mark()

    def _redraw(self) -> None:
        self._arrange()
        low, high = self._span()
        for plot in self.plots.values():
            plot.setVisible(plot in self.drawn)
        for plot in self.drawn:
            plot.plot.setXRange(low, high, padding=0.012)
            plot.plot.getAxis("bottom").setLabel(axis_title(self.curves, self.by_time))
            plot.draw(self.curves, self.by_time, self.head.log.isChecked())
        self._mark()

    def _span(self) -> tuple[float, float]:
        """Return the ends of the shared axis; in steps during a run, so that it changes seldom."""
        positions = [curve.x(self.by_time) for curve in self.curves if curve.shown]
        low = min((float(x[0]) for x in positions), default=0.0)
        high = max((float(x[-1]) for x in positions), default=1.0)
        high = max(high, low + (1e-3 if self.by_time else _LEAST_ITERATIONS))
        if any(curve.running for curve in self.curves):
            step = 10.0 ** len(f"{high - low:.0f}") / 20
            high = low + step * (1 + (high - low) // step)
        return low, high

    def _mark(self) -> None:
        x = None
        if self._shown is not None:
            record, number = self._shown
            curve = next((curve for curve in self.curves if curve.record is record and curve.shown), None)
            if curve is not None and number < len(curve.rows):
                x = float(curve.x(self.by_time)[number])
        for plot in self.drawn:
            plot.mark(x)
