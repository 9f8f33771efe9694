"""The mesh's structure in the view: irregular and sharp edges, fixed, free and locked nodes."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from hexmend.boundary.features import FEATURE_ANGLE
from hexmend_app.feature import Action, Feature, Host, Panel, Place, Seen
from hexmend_app.features.structure.structure_panel import StructurePanel

#: Text, keys and help of each layer's action, by the names of `Structure`'s fields.
_LAYERS = {
    "irregular": (
        "I&rregular edges inside",
        "S",
        "Show the singular edges: those inside the mesh that not four hexes share.",
    ),
    "boundary": (
        "Irregular edges on the &boundary",
        "B",
        "Show edges of a smooth boundary that not two hexes share.",
    ),
    "sharp": ("S&harp edges", "H", "Show where the boundary has an edge."),
    "fixed": ("Fixe&d nodes", "X", "Show nodes that no method moves."),
    "free": ("Free &nodes", "M", "Show nodes that methods may move."),
    "locked": ("&Locked nodes", "L", "Show the nodes of hexes that fixed nodes alone keep inverted."),
    "kinds": ("&Kinds of boundary nodes", "J", "Show what nodes of the boundary may do where it slides."),
    "others": ("Other c&ells", "G", "Show tetrahedra, pyramids and wedges beside the hexes, grey and see-through."),
    "original": ("&Original surface", "O", "Show the boundary as it was when the mesh was opened, see-through."),
}


class FeatureStructure(Feature):
    """Switches the layers that show a mesh's structure, and counts what they show."""

    order = 53

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self._seen = Seen()
        self.panel = StructurePanel()
        self.panel.structure_changed.connect(lambda structure: self._view.change(structure=structure))

    def actions(self) -> Sequence[Action]:
        """One for each layer."""
        return [
            Action(
                id=f"show_{name}",
                text=text,
                menu="View",
                part=2,
                keys=keys,
                help=help,
                handle=lambda on, name=name: self._switch(name, on),
                enabled=lambda name=name: self.panel.offered()[name],
                checked=lambda name=name: getattr(self._view.look.structure, name),
            )
            for name, (text, keys, help) in _LAYERS.items()
        ]

    def panels(self) -> Sequence[Panel]:
        """The layers, with what their colours mean."""
        return (
            Panel(
                id="show",
                title="Show",
                widget=self.panel,
                place=Place.TOOLS,
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
        if self._seen.another("found", session.finder.structure, session.document.start):
            self.panel.set_found(session.finder.structure)
        now = session.document.now
        if self._seen.another("others", now.mesh.cells):
            solid = [cells for cells in now.mesh.cells if cells.dimension == 3]
            self.panel.set_others({cells.kind: len(cells.nodes) for cells in solid})
        counted = now.mesh.pinned, now.summary.free_nodes, now.summary.locked_inverted
        if self._seen.another("counts", session.document.start, *counted):
            mesh, boundary = now.mesh, now.mesh.topology.boundary
            pinned = 0 if mesh.pinned is None else np.count_nonzero(mesh.pinned & mesh.topology.used & ~boundary)
            self.panel.set_nodes(
                np.count_nonzero(boundary), pinned, now.summary.free_nodes, now.summary.locked_inverted
            )  # fmt: skip

    def _class(self) -> None:
        """Have the boundary classed that the next run begins with, where somebody looks at that."""
        session = self.session
        now, smoother = session.document.now, session.order.smoother
        looked = self.panel.isVisible() or self._view.look.structure.kinds
        if looked and smoother is not None and not session.smoothing.busy:
            session.classer.ask(now.mesh, now.figures, smoother.values().get("feature_angle", FEATURE_ANGLE))
        classes = session.classer.of(now.mesh)
        error = session.classer.error
        if self._seen.another("classes", classes, error, session.document.start):
            self.panel.set_classes(classes, error)

    def _switch(self, layer: str, on: bool) -> None:
        self._view.change(structure=dataclasses.replace(self._view.look.structure, **{layer: on}))
