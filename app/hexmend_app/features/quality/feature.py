"""Quality of the mesh, at the start and now, in a strip over the view."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtGui import QGuiApplication

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.quality.quality_bar import QualityBar, figures_text
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr
from hexmend_app.widgets.overlay import Overlay


class FeatureQuality(Feature):
    """Shows the quality of the mesh as it was opened and as it is now."""

    def __init__(self, host: Host):
        super().__init__(host)
        self.bar = QualityBar(host.dialog_parent)
        self.bar.isolate_requested.connect(self._isolate)
        self.bar.hide()

    def actions(self) -> Iterable[Action]:
        """Yield the actions that show the figures in the view and copy them."""
        yield Action(
            id="key_figures",
            text=tr("&Key figures"),
            menu="View",
            section=3,
            help=tr(
                "Show inverted and invalid hexes, q min, q mean and scaled Jacobian min in the view. Side views "
                "have captions."
            ),
            handle=self._set_bar,
            checked=settings.KEY_FIGURES.get,
        )
        yield Action(
            id="copy_figures",
            text=tr("Copy quality figures"),
            help=tr("Copy all quality figures, at the start and now, as a table for a spreadsheet."),
            handle=self._copy,
        )

    def canvas_ready(self) -> None:
        """Show the key figures in the view."""
        Overlay(self.bar, self.canvas.interactor, (0.0, 1.0))
        self._show_bar()

    def refresh(self) -> None:
        """Update the figures."""
        document = self.session.document
        if not document.is_open:
            return
        if self._seen.changed("figures", document.start, document.now):
            self.bar.set_summaries(document.start.summary, document.now.summary)
        if self.canvas is not None and self._seen.changed("views", document.start, self.session.side_views.all):
            self._show_bar()

    def _set_bar(self, on: bool) -> None:
        settings.KEY_FIGURES.set(on)
        self._show_bar()

    def _show_bar(self) -> None:
        """Show the key figures of a single view; the captions of several views have figures of their own."""
        self.bar.setVisible(settings.KEY_FIGURES.get() and not self.session.side_views.all)

    def _copy(self) -> None:
        document = self.session.document
        QGuiApplication.clipboard().setText(figures_text(document.start.summary, document.now.summary))

    def _isolate(self, kind: str) -> None:
        now = self.session.document.now
        self.session.view.isolate(hexes_of_group(kind, now.mesh, now.figures))
