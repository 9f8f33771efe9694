"""How the mesh has moved: the lines between the moments that are compared, the look, and the panel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hexmend_app.features.look.colour_panel import ColourPanel
from hexmend_app.features.movement.movement_panel import MovementPanel
from hexmend_app.state.movement import MOVEMENTS, NEWLY_INVERTED, Movement
from hexmend_app.state.session import Session

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class Moving:
    """Shows what has moved, and since when.

    Parameters
    ----------
    session : Session
        The window's state.
    panel : MovementPanel
    colour_panel : ColourPanel
        Knows which range suits what the colours show.
    """

    def __init__(self, session: Session, panel: MovementPanel, colour_panel: ColourPanel):
        self._document, self._references = session.document, session.references
        view = self._view = session.view
        self._panel = panel
        self._colour_panel = colour_panel
        self._metric = view.look.scale.metric  # that was shown before a movement
        self.canvas: Canvas | None = None
        view.look_changed.connect(self._on_look_changed)
        panel.traces_changed.connect(lambda traces: view.change(traces=traces))
        panel.colours_chosen.connect(lambda name: colour_panel.choose_metric(name or self._metric))
        panel.newly_inverted_requested.connect(self._show_newly_inverted)
        panel.came_into_view.connect(self.refresh)

    def refresh(self) -> None:
        """Say how far the mesh has moved."""
        if not (self._panel.isVisible() and self._document.is_open):
            return  # it tells when it comes into view
        movement = self._movement
        self._panel.set_counts(movement.counts, movement.before.name, self._document.now.summary.free_nodes)
        if self.canvas is not None:
            self._panel.set_arrows(*self.canvas.viewport.arrows)

    @property
    def _movement(self) -> Movement:
        return self._references.movement(self._view.look.traces.since)

    def _on_look_changed(self) -> None:
        look = self._view.look
        movement = look.scale.metric in MOVEMENTS
        if not movement:
            self._metric = look.scale.metric
        self._panel.set_traces(look.traces)
        self._panel.set_colours(look.scale.metric if movement else "")
        self.refresh()

    def _show_newly_inverted(self) -> None:
        self._view.isolate(np.flatnonzero(self._movement.kinds == NEWLY_INVERTED))
