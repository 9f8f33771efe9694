"""Panel of convergence charts, stacked or in a row, with their settings and the list of runs."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QListWidget, QListWidgetItem, QSizePolicy, QVBoxLayout, QWidget

from hexmend_app.features.convergence.convergence_plot import ConvergencePlot
from hexmend_app.features.convergence.curves import CHARTS, DEFAULT_CHARTS, Curve, axis_title, colour_of
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, icon, on_theme_change, set_help, small_label, smaller
from hexmend_app.translation import tr
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.legend import swatch_icon
from hexmend_app.widgets.wording import counted

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
_LOG = "Logarithmic axes, except for quality, solver iterations and backtracks. Zero is drawn below the smallest value."
_BY_TIME = "Plot against the seconds spent in the method, or the times of a case, instead of iterations."
_SAVE = "Save the charts as SVG, PDF or PNG, or the values of all runs as CSV."
_FROM_ZERO = "Start every run at 0 instead of where it branched off."


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
        self._empty = small_label(tr(_EMPTY))
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


class ConvergenceHead(QWidget):
    """Controls that select charts and axes.

    Attributes
    ----------
    charts : dict of str to QAction
        By chart key, checked if the chart is shown.
    log, by_time, from_zero, save : QAction

    Signals
    -------
    changed
        The user selected other charts, or changed between iterations and seconds, or between linear and logarithmic.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        charts = MenuButton(tr("Charts"), tr("Select the charts."))
        charts.setText(tr("Charts ▾"))
        charts.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.charts = {
            key: charts.add(tr(chart.title), tr(chart.help), key in DEFAULT_CHARTS) for key, chart in CHARTS.items()
        }
        options = MenuButton(tr("Chart options"), tr("Axes, start of branches, save."))
        options.setIcon(icon("dots-vertical"))
        options.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.log = options.add(tr("Logarithmic axes"), tr(_LOG), True)
        self.by_time = options.add(tr("Time axis"), tr(_BY_TIME), False)
        for action in (*self.charts.values(), self.log, self.by_time):
            action.toggled.connect(self.changed)
        self.from_zero = options.add(tr("Start branches at 0"), tr(_FROM_ZERO), False)
        self.save = options.add(tr("Save…"), tr(_SAVE))
        fill(QHBoxLayout(self), charts, options, margins=(0, 0, 0, 0))


class RunList(QListWidget):
    """List of runs, the oldest first; the name of the current run is bold.

    Signals
    -------
    toggled(RunRecord, bool)
        The user showed or hid a run.
    """

    toggled = Signal(object, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._curves: Sequence[Curve] = ()
        self.setFont(smaller(self.font()))
        set_help(self, tr("Runs"), tr("Check the runs to plot; the current run is bold."))
        self.itemChanged.connect(self._on_changed)
        on_theme_change(self, lambda: self.set_curves(self._curves))

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """List these runs."""
        self._curves = curves
        with QSignalBlocker(self):
            while self.count() < len(curves):
                self.addItem(QListWidgetItem())
            while self.count() > len(curves):
                self.takeItem(self.count() - 1)
            for row, curve in enumerate(curves):
                self._show(self.item(row), curve)

    def _show(self, item: QListWidgetItem, curve: Curve) -> None:
        record = curve.record
        item.setText(record.name)
        item.setIcon(swatch_icon(colour_of(curve)))
        item.setCheckState(Qt.CheckState.Checked if curve.shown else Qt.CheckState.Unchecked)
        item.setFont(bold(self.font(), curve.current))
        values = {"title": tr(record.title), "count": counted(record.newest, record.unit)}
        if record.parent is None:
            item.setToolTip(tr("{title}: {count}.", **values))
        else:
            item.setToolTip(tr("{title}: {count}, branched from {parent}.", parent=record.parent.name, **values))

    def _on_changed(self, item: QListWidgetItem) -> None:
        self.toggled.emit(self._curves[self.row(item)].record, item.checkState() == Qt.CheckState.Checked)
