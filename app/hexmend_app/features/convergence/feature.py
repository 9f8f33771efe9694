"""Convergence feature: connects the history of runs to the charts that plot it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from superqt.utils import QSignalThrottler

from hexmend.report.charts import ChartStyle
from hexmend_app.feature import ChangeTracker, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.convergence.chart_file import figure, write_convergence
from hexmend_app.features.convergence.chart_settings import ChartSettings
from hexmend_app.features.convergence.curves import Columns, Curve, beginning
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.user_events import FileExported
from hexmend_app.widgets.dialogs.export_dialog import ChartDialog, answer

_KINDS = "SVG figure (*.svg);;PDF figure (*.pdf);;PNG picture (*.png);;All figures of all runs (*.csv)"

#: Milliseconds between two drawings while a run goes on.
_PERIOD = 100


class FeatureConvergence(Feature):
    """Brings the figures of all runs to the charts, and the user's clicks there to the timeline."""

    order = 56

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._document, self._smoothing = session.document, session.run
        timeline = self._timeline = session.timeline
        self._history = session.history
        self._columns: dict[RunRecord, Columns] = {}
        self._seen = ChangeTracker()
        self._style = ChartStyle()  # what the last figure was like
        panel = self.panel = ConvergencePanel()
        self._soon = QSignalThrottler(parent=panel)
        self._soon.setTimeout(_PERIOD)
        self._soon.triggered.connect(self._show)
        panel.choice_changed.connect(self._show)
        panel.toggled.connect(self._on_toggled)
        panel.forget_requested.connect(timeline.forget)
        panel.picked.connect(timeline.go_soon)
        panel.save_requested.connect(self.ask)

    def states(self) -> Sequence[StatePart]:
        """The settings of the charts."""
        return (
            StatePart(
                name="charts", data=ChartSettings, to_data=self.panel.head.settings, restore=self.panel.head.restore
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """The charts."""
        return (
            Panel(
                id="convergence",
                title="Convergence",
                widget=self.panel,
                place=PanelPlace.DRAWER,
                order=10,
                help="How the figures of each run went, iteration by iteration.",
            ),
        )

    def refresh(self) -> None:
        """Plot what there is: while a run goes on, ten times a second."""
        if not self.panel.isVisible():
            return
        known = [(record, record.newest, record.result) for record in self._history.records]
        if self._smoothing.phase is not Phase.RUNNING:
            if self._seen.changed("curves", known, self._timeline.record, self._timeline.moment, self._smoothing.phase):
                self._show()
        elif not self._timeline.live:
            self._mark()
        if self._smoothing.phase is Phase.RUNNING:
            self._soon.throttle()

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run."""
        self.refresh()

    def _on_toggled(self, record: RunRecord, on: bool) -> None:
        record.plotted = on
        self._show()

    def _show(self) -> None:
        records = self._history.records
        self._columns = {record: self._columns.get(record) or Columns(record) for record in records}
        for record in records:
            self._columns[record].grow()
        self.panel.set_curves([self._curve(record) for record in records if len(self._columns[record])])
        self._mark()

    def _curve(self, record: RunRecord) -> Curve:
        return Curve(
            self._columns[record],
            record.slot,
            (0.0, 0.0) if self.panel.head.from_zero.isChecked() else beginning(record),
            shown=record.plotted,
            current=record is self._timeline.record,
            going=self._smoothing.busy and record is self._smoothing.record,
            kept=lambda: self._history.kept(record),
        )

    def _mark(self) -> None:
        moment = self._timeline.moment
        if moment is None:
            self.panel.set_shown(None)
        else:
            self.panel.set_shown(moment.record, moment.number)

    # Files

    def ask(self) -> None:
        """Ask what the charts are to be like and where they go, and write them."""
        if given := answer(self.dialog()):
            path, self._style = given
            self.save(path, self._style)

    def dialog(self) -> ChartDialog:
        """The dialog that asks: sizes and names are as they were last."""
        event = self._report(Path())
        chart, proposed = figure(*event.given[1:], **event.options), f"{self.host.stem}-convergence.svg"
        return ChartDialog(chart, "the charts", proposed, _KINDS, self._style, self.host.dialog_parent)

    def save(self, path: str | Path, style: ChartStyle | None = None) -> bool:
        """Write the charts as a figure, or the figures of all runs as CSV, by the suffix; whether it was done."""
        return self.host.try_and_report(
            "The charts were not saved",
            lambda: self.session.commands.export(self._report(Path(path), style)),
            f"Convergence saved to {path}",
        )

    def _report(self, path: Path, style: ChartStyle | None = None) -> FileExported:
        """The call that writes them."""
        set_to = self.panel.head.settings()
        options = {"by_time": set_to.by_time, "log": set_to.logarithmic, "from_zero": set_to.from_zero}
        if self._timeline.record is not None:
            options["current"] = self._timeline.record
        if style is not None:
            options["style"] = style
        values = path, self._document.name, self._history.records, set_to.shown
        return FileExported("convergence", write_convergence, values, options)
