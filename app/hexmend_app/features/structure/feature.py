"""Layers of the mesh structure: irregular and sharp edges; fixed, free and locked nodes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.picture.layer_switch import ordered_layers
from hexmend_app.translation import tr


class FeatureStructure(Feature):
    """Shows and hides the layers of the mesh structure, with counts."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self.panel = StructurePanel()
        self.panel.structure_changed.connect(lambda structure: self._view.change(structure=structure))

    def actions(self) -> Iterable[Action]:
        """Yield an action for each layer."""
        for layer in ordered_layers():
            yield Action(
                id=f"show_{layer.name}",
                text=tr(layer.action or layer.title),
                menu="View/Show",
                keys=layer.keys,
                help=tr(layer.action_help or layer.help),
                handle=lambda on, name=layer.name: self._switch(name, on),
                enabled=lambda name=layer.name: self.panel.offered()[name],
                checked=lambda name=layer.name: self._view.look.structure.is_on(name),
            )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel with the layers and their legends."""
        yield Panel(
            id="show",
            title=tr("Show"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=21,
            help=tr("Edges, nodes and surfaces that are drawn over the mesh."),
        )

    def refresh(self) -> None:
        """Update check boxes, legends and counts."""
        session = self.session
        self.panel.setEnabled(session.document.is_open)
        self.panel.set_structure(self._view.look.structure)
        if not session.document.is_open:
            return
        self._classify_boundary()
        if self._seen.changed("found", session.structure_finder.result, session.document.start):
            self.panel.set_found(session.structure_finder.result)
        now = session.document.now
        of_mesh = now.mesh.cells, now.mesh.materials, now.mesh.target, now.mesh.mid_nodes
        if self._seen.changed("legends", session.document.start, *of_mesh):
            for layer in ordered_layers():
                if layer.drawn_by is not None:
                    self.panel.set_legend(layer.name, layer.drawn_by.legend(now.mesh))  # type: ignore[attr-defined]
            self.panel.set_curved(now.mesh.mid_nodes)
        summary = now.summary
        counted = now.mesh.pinned, summary.free_nodes, summary.locked_inverted
        if self._seen.changed("counts", session.document.start, *counted):
            mesh, boundary = now.mesh, now.mesh.topology.boundary
            pinned = 0 if mesh.pinned is None else int(np.sum(mesh.pinned & mesh.topology.used & ~boundary))
            interfaces = mesh.interfaces
            between = 0 if interfaces is None else int(np.sum(interfaces.interface_nodes & ~boundary))
            counts = int(np.sum(boundary)), pinned, summary.free_nodes, summary.locked_inverted
            self.panel.set_nodes(*counts, between)

    def _classify_boundary(self) -> None:
        """Classify the boundary nodes for the next run if the result is visible."""
        session = self.session
        now, smoother = session.document.now, session.run_setup.smoother
        visible = self.panel.isVisible() or self._view.look.structure.is_on("kinds")
        if visible and smoother is not None and not session.run.busy:
            session.boundary_classifier.ask(
                now.mesh, now.quality, smoother.values().get("feature_angle", FEATURE_ANGLE)
            )
        classes = session.boundary_classifier.of(now.mesh)
        error = session.boundary_classifier.error
        if self._seen.changed("classes", classes, error, session.document.start):
            self.panel.set_classes(classes, error)

    def _switch(self, layer: str, on: bool) -> None:
        self._view.change(structure=self._view.look.structure.switched(layer, on))
