"""The boundary of the mesh as opened, translucent, behind the current mesh."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.scene.layers.flat_actor import offset_depth
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.theme.palette import ORIGINAL

#: Depth offsets of faces and edges, in VTK's units, which hide them where the boundary is unchanged.
_FACES_BEHIND, _EDGES_BEHIND = 40.0, 400.0


@layer(
    "original",
    title="Original surface",
    help="The translucent boundary of the mesh as opened, visible where the boundary has moved.",
    empty="None: the mesh has no boundary.",
    action="&Original surface",
    action_help="Show the boundary of the mesh as opened, translucent.",
    keys="O",
    order=90,
)
class OriginalSurface(TranslucentSurface, OptionalLayer):
    """Draws the boundary of a mesh as opened."""

    colour, edge_opacity = ORIGINAL, 0.55

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        for actor in self.actors:
            offset_depth(actor.GetMapper(), polygons=_FACES_BEHIND, lines=_EDGES_BEHIND)

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the original boundary faces of shown hexes; an unchanged surface is not rebuilt."""
        if frame.original is None:
            self.hide()
            return
        if self.changes(frame.original, frame.curved, keep):
            topology = frame.mesh.topology
            hexes = np.nonzero(topology.face_neighbours < 0)[0]
            shown = slice(None) if keep is None else keep[hexes]
            self.set_faces(frame, frame.original, Faces.of(topology.boundary_faces[shown], hexes[shown]))
        self.show()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry if the mesh has a boundary."""
        return [(ORIGINAL, True, "as opened")] if mesh.topology.boundary.any() else []
