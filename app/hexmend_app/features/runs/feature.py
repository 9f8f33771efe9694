"""Results of all runs in a table of dots, with those that no other run dominates."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hexmend_app.feature import ChangeTracker, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.runs.dominance import KEY_FIGURES, dominating
from hexmend_app.features.runs.run_table import RunRow
from hexmend_app.features.runs.runs_panel import RunsPanel
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.theme.palette import MUTED, RUN_COLOURS
from hexmend_app.translation import tr


class FeatureRuns(Feature):
    """Compares the results of the runs in the history; a click shows one."""

    order = 57
    shows_iterations = True

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self.panel = RunsPanel()
        self.panel.chosen.connect(self._show)

    def panels(self) -> Sequence[Panel]:
        """Return the panel of results."""
        return (
            Panel(
                id="runs",
                title=tr("Runs"),
                widget=self.panel,
                place=PanelPlace.DRAWER,
                group=PanelGroup.SMOOTH,
                order=15,
                help=tr("Results of all runs and of the mesh at the start, and which of them dominate."),
            ),
        )

    def refresh(self) -> None:
        """Show the results of the runs; an active run shows its newest iteration."""
        session = self.session
        if not self.panel.isVisible() or not session.document.is_open:
            return
        records = [one for one in session.history.records if one.rows and not one.holds_times]
        state = [(one, one.newest, one.end) for one in records]
        if self._seen.changed("rows", state, session.document.start, session.run.busy):
            self.panel.set_rows(self._rows(records))
        moment = session.timeline.shown_iteration
        shown = moment.record if moment is not None and moment.number else None
        at_start = session.document.now.mesh.points is session.document.start.mesh.points
        if self._seen.changed("shown", shown, at_start, records):
            self.panel.set_shown(shown, at_start)

    def _rows(self, records: Sequence[RunRecord]) -> list[RunRow]:
        """Return a row for the mesh at the start and one for each run; none without runs."""
        if not records:
            return []
        start = self.session.document.start.summary.to_dict()
        figures = [{key: start[key] for key in KEY_FIGURES}, *map(_figures, records)]
        names = [tr("At the start"), *(record.name for record in records)]
        better = [tuple(names[at] for at in found) for found in dominating(figures)]
        run = self.session.run
        rows = [RunRow(None, names[0], "", figures[0], MUTED, better[0])]
        for k, record in enumerate(records, 1):
            colour, running = RUN_COLOURS[record.slot % len(RUN_COLOURS)], run.busy and record is run.record
            rows.append(RunRow(record, names[k], record.settings, figures[k], colour, better[k], running))
        return rows

    def _show(self, record: RunRecord | None) -> None:
        """Show the result of a run, or the mesh at the start."""
        timeline = self.session.timeline
        if record is not None:
            timeline.choose(record)
        else:
            timeline.go_to_start()


def _figures(record: RunRecord) -> dict[str, Any]:
    """Return the key figures of the result of a run, or of its newest iteration."""
    if record.end is not None:
        summary = record.end.summary.to_dict()
        return {key: summary[key] for key in KEY_FIGURES}
    return {key: record.rows[-1][key] for key in KEY_FIGURES}
