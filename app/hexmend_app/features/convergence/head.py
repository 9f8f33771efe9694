"""Controls above the convergence charts: charts shown, axis and scale."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QSizePolicy, QWidget

from hexmend_app.features.convergence.chart_settings import ChartSettings
from hexmend_app.features.convergence.charts import CHARTS, FIRST
from hexmend_app.theme.style import icon, smaller
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.inputs.segmented import Segmented

_LOG = "Axes by powers of ten, but for quality and the counts of solver iterations and cuts; zero stands below them."
_FROM_ZERO = "Lay all runs over one another from their start, rather than let a branch begin where it left its parent."


class ConvergenceHead(QWidget):
    """Chooses charts and axes; asks to save.

    Attributes
    ----------
    charts : dict of str to QAction
        By the charts' keys, checked where they are drawn.
    log, from_zero, save : QAction
    axis : Segmented

    Signals
    -------
    charts_changed
        Others are to be drawn.
    axes_changed
        Iterations or seconds, linear or logarithmic.
    from_zero_changed
        Where branches begin.
    save_requested
    """

    charts_changed = Signal()
    axes_changed = Signal()
    from_zero_changed = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.charts = {key: self._action(chart.title, chart.help, key in FIRST) for key, chart in CHARTS.items()}
        for action in self.charts.values():
            action.toggled.connect(self.charts_changed)
        which = MenuButton("Charts", "Which figures are plotted, each in a chart of its own.")
        which.setText("Charts ▾")
        which.menu().addActions(list(self.charts.values()))
        which.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.log = self._action("Logarithmic axes", _LOG, True)
        self.log.toggled.connect(self.axes_changed)
        self.from_zero = self._action("Branches begin at 0", _FROM_ZERO, False)
        self.from_zero.toggled.connect(self.from_zero_changed)
        self.save = self._action("Save…", "Save the charts as SVG, PDF or PNG, or the figures of all runs as CSV.")
        self.save.triggered.connect(self.save_requested)
        more = MenuButton("More of the charts", "Logarithmic axes, where branches begin, and saving.")
        more.setIcon(icon("dots-vertical"))
        more.menu().addActions([self.log, self.from_zero, self.save])
        self.axis = Segmented(
            "Axis of the charts",
            [
                ("iteration", "Iteration", "Plot against the number of the iteration."),
                ("time", "Time", "Plot against the seconds that the method took."),
            ],
        )
        self.axis.setFont(smaller(self.font()))
        self.axis.chosen.connect(self.axes_changed)
        buttons = QHBoxLayout()
        for part in (which, more):
            part.setFixedHeight(self.axis.sizeHint().height())
            buttons.addWidget(part)
        self._layout = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.addLayout(buttons, 1)
        self._layout.addWidget(self.axis)

    def _action(self, text: str, help: str, on: bool | None = None) -> QAction:
        action = QAction(text, self)
        action.setCheckable(on is not None)
        action.setChecked(bool(on))
        action.setToolTip(f"<qt>{help}</qt>")
        return action

    def set_in_a_row(self, on: bool) -> None:
        """Lay its parts side by side, or below one another."""
        directions = QBoxLayout.Direction
        self._layout.setDirection(directions.LeftToRight if on else directions.TopToBottom)

    @property
    def by_time(self) -> bool:
        """Return True if the axis shows seconds."""
        return self.axis.value() == "time"

    def settings(self) -> ChartSettings:
        """Return the settings."""
        shown = tuple(key for key, action in self.charts.items() if action.isChecked())
        return ChartSettings(shown, self.log.isChecked(), self.from_zero.isChecked(), self.by_time)

    def restore(self, settings: ChartSettings) -> None:
        """Set all of it, and say so."""
        for key, action in self.charts.items():
            action.setChecked(key in settings.shown)
        self.log.setChecked(settings.logarithmic)
        self.from_zero.setChecked(settings.from_zero)
        self.axis.set_value("time" if settings.by_time else "iteration")
        self.axes_changed.emit()
