"""Displacement of the mesh since a reference: arrows and counts."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.feature import Feature, Host, Panel, PanelPlace
from hexmend_app.features.movement.movement_panel import MovementPanel
from hexmend_app.picture.displacement import Displacement
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.translation import tr


class FeatureMovement(Feature):
    """Shows the displacement of the nodes since a reference state."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._document, view = self.session.document, self.session.view
        self._view = view
        panel = self.panel = MovementPanel()
        panel.traces_changed.connect(lambda traces: view.change(movement=traces))
        panel.show_newly.clicked.connect(self._show_newly_invalid)

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of the displacement."""
        yield Panel(
            id="movement",
            title=tr("Movement"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=22,
            help=tr("Displacement of the nodes and change of quality since a reference state."),
        )

    def refresh(self) -> None:
        """Show the settings of the view, the counts of moved nodes and the number of arrows."""
        self.panel.setEnabled(self._document.is_open)
        self.panel.set_traces(self._view.look.movement)
        if not (self.panel.isVisible() and self._document.is_open):
            return
        displacement = self._displacement
        if self._seen.changed("counts", displacement):
            name = displacement.before.name
            self.panel.set_counts(displacement.counts, name, self._document.now.summary.free_nodes)
        if self.canvas is not None:
            layer = self.canvas.viewport.overlay_layers.arrows
            self.panel.set_arrows(layer.drawn, layer.moved)

    @property
    def _displacement(self) -> Displacement:
        return self.session.comparison_bases.displacement(self._view.look.movement.since)

    def _show_newly_invalid(self) -> None:
        now = self._document.now
        self._view.isolate(hexes_of_group("newly invalid", now.mesh, now.figures, self._displacement))
