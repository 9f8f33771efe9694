"""Feature that draws the mesh in the 3D view and sets its appearance."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

import numpy as np

from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.appearance.colour_panel import ColourPanel
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.displacement import Displacement
from hexmend_app.picture.layer_switch import EDGE_LAYERS
from hexmend_app.scene.colour.material_colours import material_values
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.tasks.boundary_classifier import BoundaryClasses
from hexmend_app.translation import tr


class FeatureAppearance(Feature):
    """Draws the session's mesh, and applies the colour panel to its appearance."""

    def __init__(self, host: Host):
        super().__init__(host)
        view = self._view = self.session.view
        self.panel = ColourPanel()
        self.panel.colours_changed.connect(lambda colours: view.change(colours=colours))
        self.panel.shading.clicked.connect(lambda on: view.change(page={"shading": on}))
        view.metric_wanted.connect(self.panel.choose_metric)
        self.session.run.iterated.connect(self._show_mesh)

    def actions(self) -> Iterable[Action]:
        """Yield the action that switches edges."""
        view = self._view
        yield Action(
            id="edges",
            text=tr("&Edges"),
            menu="View",
            section=1,
            keys="E",
            icon="grid",
            help=tr("Show the edges of the hexes."),
            tool=tr("Edges"),
            handle=lambda on: view.change(lines={"edges": None if on else 0.0}),
            checked=lambda: view.look.lines.shown,
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of colours."""
        yield Panel(
            id="look",
            title=tr("Look"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=20,
            help=tr("Metric or material, map and range of the colours, neutral colours, shading."),
        )

    def canvas_ready(self) -> None:
        """Connect the colour bar, whose special swatches and names of materials isolate hexes."""
        self.canvas.colour_bar.special_clicked.connect(self._isolate)
        self.canvas.colour_bar.material_clicked.connect(self._isolate_material)

    def refresh(self) -> None:
        """Draw the current mesh, and show the present look in the panel."""
        self._show_mesh()
        self._show_panel()

    def _show_mesh(self) -> None:
        """Draw the current mesh; if that fails, clear the view rather than show the previous mesh."""
        document = self.session.document
        if self.canvas is not None and document.is_open:
            try:
                self._draw()
            except Exception:
                if not self.canvas.shows(document.now.mesh):
                    self.canvas.clear()
                raise

    def _show_panel(self) -> None:
        self.panel.setEnabled(self.session.document.is_open)
        self.panel.set_colours(self._view.look.colours)
        self.panel.shading.setChecked(self._view.look.page.shading)
        if self.canvas is not None and self.canvas.colouring is not None:
            self.panel.set_ends(self.canvas.colouring.low, self.canvas.colouring.high)

    def _draw(self) -> None:
        session = self.session
        now, movement, look = session.document.now, self._movement, self._drawable
        classes = self._classes if look.structure.is_on("kinds") else None
        kinds = (None, None) if classes is None else (classes.kinds, classes.original_kinds)
        original = session.document.start.mesh.points if look.structure.is_on("original") else None
        if self._seen.changed("frame", now, movement, look, original, *kinds):
            live = session.run.phase is Phase.RUNNING and session.run.following
            self.canvas.draw(Frame(now.mesh, now.quality, movement, look, original, *kinds), live)
        if self._seen.changed("handles", look.cut, self._view.handles, self._view.plane_at):
            self.canvas.show_handles(self._view.handles, self._view.plane_at)
        if self._seen.changed("phase", session.run.phase) and session.run.phase is not Phase.RUNNING:
            self.canvas.rest()
        if self.canvas.isHidden():
            self.canvas.show()
            self.canvas.interactor.setFocus()  # for the keys of the view

    def _isolate(self, kind: str) -> None:
        self._view.isolate_group(kind, self._movement)

    def _isolate_material(self, number: int) -> None:
        materials = material_values(self.session.document.now.mesh)
        self._view.isolate(np.flatnonzero(materials == number).tolist(), rings=0)

    @property
    def _movement(self) -> Displacement | None:
        """Displacement shown by colours or arrows, or None."""
        look = self._view.look
        return self.session.comparison_bases.displacement(look.movement.since) if look.shows_movement else None

    @property
    def _drawable(self) -> Look:
        """Appearance without edges and node classes that are still being computed, for which drawing would wait."""
        look = self._view.look
        structure = look.structure
        if self.session.structure_finder.result is None:
            structure = structure.without(*EDGE_LAYERS)
        if self._classes is None:
            structure = structure.without("kinds")
        return dataclasses.replace(look, structure=structure)

    @property
    def _classes(self) -> BoundaryClasses | None:
        """Classes of the boundary nodes, or None if not computed yet."""
        return self.session.boundary_classifier.of(self.session.document.now.mesh)
