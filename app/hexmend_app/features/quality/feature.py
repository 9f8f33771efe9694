"""Quality statistics of the mesh, at the start and now."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import ChangeTracker, Feature, Host, Panel, PanelPlace
from hexmend_app.features.quality.statistics import StatisticsTable
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.translation import tr


class FeatureQuality(Feature):
    """Shows the quality statistics of the mesh as it was opened and as it is now."""

    order = 41
    shows_iterations = True

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self.panel = StatisticsTable()
        self.panel.isolate_requested.connect(self._isolate)

    def panels(self) -> Sequence[Panel]:
        """Return the table of statistics."""
        return (
            Panel(
                id="quality",
                title=tr("Quality"),
                widget=self.panel,
                place=PanelPlace.FACTS,
                order=20,
                help=tr("Quality statistics of the mesh, now and as it was opened."),
            ),
        )

    def refresh(self) -> None:
        """Update the statistics."""
        document = self.session.document
        if document.is_open and self._seen.changed("figures", document.start, document.now):
            self.panel.set_summaries(document.start.summary, document.now.summary)

    def _isolate(self, kind: str) -> None:
        now = self.session.document.now
        self.session.view.isolate(hexes_of_group(kind, now.mesh, now.figures))
