"""The mesh's quality in figures, now beside what it was when it was opened."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import ChangeTracker, Feature, Host, Panel, PanelPlace
from hexmend_app.features.quality.statistics import StatisticsTable
from hexmend_app.state.mesh.hex_groups import hexes_of_group


class FeatureQuality(Feature):
    """Shows the summary of the mesh as it is, beside that of the mesh as it was opened."""

    order = 41

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self.panel = StatisticsTable()
        self.panel.isolate_requested.connect(self._isolate)

    def panels(self) -> Sequence[Panel]:
        """The table."""
        return (
            Panel(
                id="quality",
                title="Quality",
                widget=self.panel,
                place=PanelPlace.FACTS,
                order=20,
                help="The mesh's quality in figures, now and as it was opened.",
            ),
        )

    def refresh(self) -> None:
        """Show the figures as they are now."""
        document = self.session.document
        if document.is_open and self._seen.changed("figures", document.start, document.now):
            self.panel.set_summaries(document.start.summary, document.now.summary)

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run."""
        self.refresh()

    def _isolate(self, kind: str) -> None:
        now = self.session.document.now
        self.session.view.isolate(hexes_of_group(kind, now.mesh, now.figures))
