"""The mesh's structure in the view: irregular and sharp edges, fixed, free and locked nodes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.boundary.features import FEATURE_ANGLE
from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelPlace
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.picture.layer_switch import ordered_layers


class FeatureStructure(Feature):
    """Switches the layers that show a mesh's structure, and counts what they show."""

    order = 53

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self._seen = ChangeTracker()
        self.panel = StructurePanel()
        self.panel.structure_changed.connect(lambda structure: self._view.change(structure=structure))

    def actions(self) -> Sequence[Action]:
        """One for each layer."""
        return [
            Action(
                id=f"show_{layer.name}",
                text=layer.action or layer.title,
                menu="View",
                part=2,
                keys=layer.keys,
                help=layer.action_help or layer.help,
                handle=lambda on, name=layer.name: self._switch(name, on),
                enabled=lambda name=layer.name: self.panel.offered()[name],
                checked=lambda name=layer.name: self._view.look.structure.is_on(name),
            )
            for layer in ordered_layers()
        ]

    def panels(self) -> Sequence[Panel]:
        """The layers, with what their colours mean."""
        return (
            Panel(
                id="show",
                title="Show",
                widget=self.panel,
                place=PanelPlace.TOOLS,
                order=40,
                help="Edges and nodes that are shown over the mesh.",
            ),
        )

    def refresh(self) -> None:
        """Show what is switched on, and how many there are."""
        session = self.session
        self.panel.setEnabled(session.document.is_open)
        self.panel.set_structure(self._view.look.structure)
        if not session.document.is_open:
            return
        self._class()
        if self._seen.changed("found", session.structure_finder.structure, session.document.start):
            self.panel.set_found(session.structure_finder.structure)
        now = session.document.now
        if self._seen.changed("legends", session.document.start, now.mesh.cells):
            for layer in ordered_layers():
                if layer.drawn_by is not None:
                    self.panel.set_legend(layer.name, layer.drawn_by.legend(now.mesh))
        counted = now.mesh.pinned, now.summary.free_nodes, now.summary.locked_inverted
        if self._seen.changed("counts", session.document.start, *counted):
            mesh, boundary = now.mesh, now.mesh.topology.boundary
            pinned = 0 if mesh.pinned is None else np.count_nonzero(mesh.pinned & mesh.topology.used & ~boundary)
            self.panel.set_nodes(
                np.count_nonzero(boundary), pinned, now.summary.free_nodes, now.summary.locked_inverted
            )  # fmt: skip

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run."""
        self.refresh()

    def _class(self) -> None:
        """Have the boundary classed that the next run begins with, where somebody looks at that."""
        session = self.session
        now, smoother = session.document.now, session.run_setup.smoother
        looked = self.panel.isVisible() or self._view.look.structure.kinds
        if looked and smoother is not None and not session.run.busy:
            session.boundary_classifier.ask(
                now.mesh, now.figures, smoother.values().get("feature_angle", FEATURE_ANGLE)
            )
        classes = session.boundary_classifier.of(now.mesh)
        error = session.boundary_classifier.error
        if self._seen.changed("classes", classes, error, session.document.start):
            self.panel.set_classes(classes, error)

    def _switch(self, layer: str, on: bool) -> None:
        self._view.change(structure=self._view.look.structure.switched(layer, on))
