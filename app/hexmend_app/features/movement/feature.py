"""How the mesh has moved: the moments that are compared, the look, and the panel that counts."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, Displacement
from hexmend_app.feature import Feature, Host, Panel, Place, Seen
from hexmend_app.features.movement.movement_panel import MovementPanel
from hexmend_app.state.kinds import of_kind


class FeatureMovement(Feature):
    """Shows what has moved, and since when."""

    order = 57

    def __init__(self, host: Host):
        super().__init__(host)
        self._document, view = self.session.document, self.session.view
        self._view = view
        self._metric = view.look.scale.metric  # that was shown before a movement
        self._seen = Seen()
        panel = self.panel = MovementPanel()
        panel.traces_changed.connect(lambda traces: view.change(traces=traces))
        panel.colours_chosen.connect(lambda name: view.colour_by(name or self._metric))
        panel.newly_inverted_requested.connect(self._show_newly_inverted)

    def panels(self) -> Sequence[Panel]:
        """How far what has moved."""
        return (
            Panel(
                id="movement",
                title="Movement",
                widget=self.panel,
                place=Place.DRAWER,
                order=30,
                help="How far nodes have moved, and what that changed, since a moment of your choice.",
                scrolls=True,
            ),
        )

    def refresh(self) -> None:
        """Say how far the mesh has moved."""
        self.panel.setEnabled(self._document.is_open)
        look = self._view.look
        movement = look.scale.metric in DISPLACEMENT_QUANTITIES
        if not movement:
            self._metric = look.scale.metric
        self.panel.set_traces(look.traces)
        self.panel.set_colours(look.scale.metric if movement else "")
        if not (self.panel.isVisible() and self._document.is_open):
            return
        moved = self._movement
        if self._seen.another("counts", moved):
            self.panel.set_counts(moved.counts, moved.before.name, self._document.now.summary.free_nodes)
        if self.canvas is not None:
            layer = self.canvas.viewport.extras.arrows
            self.panel.set_arrows(layer.drawn, layer.moved)

    @property
    def _movement(self) -> Displacement:
        return self.session.references.movement(self._view.look.traces.since)

    def _show_newly_inverted(self) -> None:
        now = self._document.now
        self._view.isolate(of_kind("newly inverted", now.mesh, now.figures, self._movement))
