"""The surface of a file on which the boundary slides, translucent."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.flat_actor import offset_depth
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.theme.palette import TARGET

#: Depth offset of the faces, in VTK's units, which hides them where they are on the boundary.
_BEHIND = 40.0
#: Letters of a file's name in the legend.
_MAX_LETTERS = 20


@layer(
    "target",
    title="Target surface",
    help="The translucent surface of a file on which the boundary slides.",
    empty="None: the boundary slides on itself.",
    action="&Target surface",
    action_help="Show the surface of a file on which the boundary slides, translucent.",
    order=91,
)
class TargetSurfaceLayer(TranslucentSurface, OptionalLayer):
    """Draws the surface on which the boundary of a mesh slides, if that is not its own."""

    colour, face_opacity = TARGET, 0.3

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        offset_depth(self.actors[0].GetMapper(), polygons=_BEHIND)

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the whole surface without its many edges; an unchanged surface is not rebuilt."""
        target = frame.mesh.target
        if target is None:
            self.hide()
            return
        if self.changes(target):
            self.set_data(pv.PolyData.from_regular_faces(target.points, target.faces), edges=False)
        self.show()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry, with the name of the file, if the mesh has such a surface."""
        if mesh.target is None:
            return []
        name = printable(mesh.target.name) or "surface"
        return [(TARGET, False, name if len(name) <= _MAX_LETTERS else f"{name[: _MAX_LETTERS - 1]}…")]
