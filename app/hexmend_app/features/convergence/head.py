"""Controls of the convergence charts: selected charts, axis and scale."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from hexmend_app.features.convergence.charts import CHARTS, DEFAULT_CHARTS, ChartSettings
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.menu_button import MenuButton

_LOG = "Logarithmic axes, except for quality, solver iterations and backtracks. Zero is drawn below the smallest value."
_BY_TIME = "Plot against the seconds spent in the method, or the times of a case, instead of iterations."
_SAVE = "Save the charts as SVG, PDF or PNG, or the values of all runs as CSV."
_FROM_ZERO = "Start every run at 0 instead of where it branched off."


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

    def settings(self) -> ChartSettings:
        """Return the settings."""
        shown = tuple(key for key, action in self.charts.items() if action.isChecked())
        return ChartSettings(shown, self.log.isChecked(), self.from_zero.isChecked(), self.by_time.isChecked())

    def restore(self, settings: ChartSettings) -> None:
        """Apply settings."""
        for key, action in self.charts.items():
            action.setChecked(key in settings.shown)
        self.log.setChecked(settings.logarithmic)
        self.from_zero.setChecked(settings.from_zero)
        self.by_time.setChecked(settings.by_time)
