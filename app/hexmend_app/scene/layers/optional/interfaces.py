"""Interfaces between the materials of a mesh."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.scene.layers.flat_actor import offset_depth
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.theme.palette import INTERFACE

#: Depth offsets of faces and of edges, in VTK's units, which show them in front of those of the hexes.
_IN_FRONT, _EDGES_IN_FRONT = -4.0, -8.0
#: Width of the edges of interfaces, in thin lines.
_EDGE_WIDTH = 2.0


@layer(
    "interfaces",
    title="Interfaces",
    help="The faces between hexes of different material, translucent, with their edges.",
    empty="None: the mesh has one material.",
    action="&Interfaces between materials",
    action_help="Show the faces between hexes of different material.",
    keys="U",
    order=92,
)
class InterfaceLayer(TranslucentSurface, OptionalLayer):
    """Draws the faces between materials; unchanged ones are not rebuilt."""

    colour, edge_opacity = INTERFACE, 0.9

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        self.actors[1].GetProperty().SetLineWidth(_EDGE_WIDTH * pixel_ratio)
        for actor in self.actors:
            offset_depth(actor.GetMapper(), polygons=_IN_FRONT, lines=_EDGES_IN_FRONT, slope=-1.0)

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the faces at shown hexes."""
        mesh = frame.mesh
        if mesh.materials is None:
            self.hide()
            return
        if self.changes(mesh.points, mesh.materials, frame.curved, keep):
            faces, sides = mesh.materials.interface_faces, mesh.materials.interface_sides
            shown = slice(None) if keep is None else keep[sides[:, [0, 2]]].any(axis=1)
            self.set_faces(frame, mesh.points, Faces.of(faces[shown], sides[shown, 0]))
        self.show()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry if the mesh has several materials."""
        if mesh.materials is None:
            return []
        count = int(np.count_nonzero(mesh.materials.interface_nodes & ~mesh.topology.boundary))
        return [(INTERFACE, True, f"{count:,} inside")]
