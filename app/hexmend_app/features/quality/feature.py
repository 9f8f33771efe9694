"""Quality statistics of the mesh, at the start and now."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.canvas.canvas import Canvas
from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelPlace
from hexmend_app.features.quality.quality_bar import QualityBar
from hexmend_app.features.quality.statistics import StatisticsTable
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr
from hexmend_app.widgets.overlay import Overlay


class FeatureQuality(Feature):
    """Shows the quality statistics of the mesh as it was opened and as it is now."""

    order = 41
    shows_iterations = True

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self.panel = StatisticsTable()
        self.panel.isolate_requested.connect(self._isolate)
        self.bar = QualityBar(host.dialog_parent)
        self.bar.hide()

    def actions(self) -> Sequence[Action]:
        """Return the action that shows the key figures in the view."""
        return (
            Action(
                id="key_figures",
                text=tr("&Key figures"),
                menu="View",
                part=3,
                help=tr(
                    "Show inverted and invalid hexes, q min, q mean and scaled Jacobian min in the view. Side views "
                    "have captions."
                ),
                handle=self._set_bar,
                checked=settings.KEY_FIGURES.get,
            ),
        )

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

    def canvas_ready(self, canvas: Canvas) -> None:
        """Show the key figures in the view."""
        Overlay(self.bar, canvas.interactor, (0.0, 1.0), key="key_figures")
        self._show_bar()

    def refresh(self) -> None:
        """Update the statistics."""
        document = self.session.document
        if not document.is_open:
            return
        if self._seen.changed("figures", document.start, document.now):
            summaries = document.start.summary, document.now.summary
            self.panel.set_summaries(*summaries)
            self.bar.set_summaries(*summaries)
        if self.canvas is not None and self._seen.changed("views", document.start, self.session.side_views.all):
            self._show_bar()

    def _set_bar(self, on: bool) -> None:
        settings.KEY_FIGURES.set(on)
        self._show_bar()

    def _show_bar(self) -> None:
        """Show the key figures of a single view; the captions of several views have figures of their own."""
        self.bar.setVisible(settings.KEY_FIGURES.get() and not self.session.side_views.all)

    def _isolate(self, kind: str) -> None:
        now = self.session.document.now
        self.session.view.isolate(hexes_of_group(kind, now.mesh, now.figures))
