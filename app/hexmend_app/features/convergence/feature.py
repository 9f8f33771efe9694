"""Feature that plots the history of runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from superqt.utils import QSignalThrottler

from hexmend.report.records import write_csv
from hexmend_app.chart_feature import ChartFeature
from hexmend_app.feature import Host, Panel, PanelPlace, StatePart
from hexmend_app.features.convergence.curves import Curve, axis_title, described, run_start, table_rows
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.report.convergence import Convergence
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.saved_values import saved_values

#: Milliseconds between two redraws during a run.
_PERIOD = 100


class FeatureConvergence(ChartFeature):
    """Plots the values of all runs and sends clicks in the charts to the timeline."""

    chart_title, chart_subject, values_title = "Convergence", "the charts", "Values of all runs"

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._document, self._run = session.document, session.run
        timeline = self._timeline = session.timeline
        self._history = session.history
        panel = self.panel = ConvergencePanel()
        self._throttler = QSignalThrottler(parent=panel)
        self._throttler.setTimeout(_PERIOD)
        self._throttler.triggered.connect(self._show)
        panel.head.from_zero.toggled.connect(self._show)
        panel.runs.toggled.connect(self._on_toggled)
        panel.picked.connect(timeline.go_soon)
        panel.head.save.triggered.connect(self.ask)

    def states(self) -> Iterable[StatePart]:
        """Yield the settings of the charts."""
        head = self.panel.head
        yield saved_values("charts", log=head.log, by_time=head.by_time, from_zero=head.from_zero, **head.charts)

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of charts."""
        yield Panel(
            id="convergence",
            title=tr("Convergence"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=10,
            help=tr("Convergence of each run, iteration by iteration."),
        )

    def refresh(self) -> None:
        """Plot the runs; during a run at most ten times a second."""
        if not self.panel.isVisible():
            return
        states = [(record, record.newest, record.result) for record in self._history.records]
        if self._run.phase is not Phase.RUNNING:
            timeline = self._timeline
            if self._seen.changed("curves", states, timeline.record, timeline.shown_iteration, self._run.phase):
                self._show()
        elif not self._timeline.live:
            self._mark()
        if self._run.phase is Phase.RUNNING:
            self._throttler.throttle()

    def _on_toggled(self, record: RunRecord, on: bool) -> None:
        record.plotted = on
        self._show()

    def _show(self) -> None:
        self.panel.set_curves([self._curve(record) for record in self._history.records if record.rows])
        self._mark()

    def _curve(self, record: RunRecord) -> Curve:
        return Curve(
            record,
            record.slot,
            (0.0, 0.0) if self.panel.head.from_zero.isChecked() else run_start(record),
            shown=record.plotted,
            current=record is self._timeline.record,
            running=self._run.busy and record is self._run.record,
        )

    def _mark(self) -> None:
        iteration = self._timeline.shown_iteration
        if iteration is None:
            self.panel.set_shown(None)
        else:
            self.panel.set_shown(iteration.record, iteration.number)

    # Files

    def write_values(self, path: Path, names: Mapping[str, str]) -> None:
        """Write the values of all runs as CSV."""
        self._show()
        write_csv(path, [row for curve in self.panel.curves for row in table_rows(curve, names)])

    def described(self) -> Convergence:
        """Return the charts that are selected, for print."""
        self._show()
        curves, by_time, log = self.panel.curves, self.panel.by_time, self.panel.head.log.isChecked()
        charts = [described(plot.chart, curves, by_time, log, for_print=True) for plot in self.panel.drawn]
        return Convergence(charts, self._document.name, axis_title(curves, by_time), not by_time)
