"""Interfaces between the materials of a mesh, and the hexes coloured by material."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable
from hexmend_app.scene.geometry.filters import same_mask
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import INTERFACE, SHARP, rgb

#: Colours of materials, repeated where there are more: Paul Tol's "muted", without its grey.
MATERIAL_COLOURS = (
    *("#88ccee", "#cc6677", "#ddcc77", "#117733", "#332288"),
    *("#aa4499", "#44aa99", "#999933", "#882255", "#6699cc"),
)
#: Materials that the legend names, and letters of a name.
_MAX_NAMED, _MAX_LETTERS = 10, 14
#: Depth offsets of faces and of edges, in VTK's units, which show them in front of those of the hexes.
_IN_FRONT, _EDGES_IN_FRONT = -200.0, -400.0
#: Width of the edges of interfaces, in thin lines.
_EDGE_WIDTH = 2.0
#: Light from all sides and from the lamp, as of the hexes.
_AMBIENT, _DIFFUSE = 0.58, 0.47


class _MaterialLayer(TranslucentSurface, OptionalLayer):
    """Draws faces of a mesh of several materials; unchanged ones are not rebuilt."""

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        for actor in self.actors:
            mapper = actor.GetMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, _IN_FRONT)
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, _EDGES_IN_FRONT)
        self._drawn: tuple[object, object] = (None, None)
        self._keep: np.ndarray | None = None

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the faces at shown hexes."""
        mesh = frame.mesh
        if mesh.materials is None:
            self.hide()
            return
        drawn = mesh.points, mesh.materials
        if any(one is not other for one, other in zip(drawn, self._drawn, strict=True)) or not same_mask(
            keep, self._keep
        ):
            self._drawn, self._keep = drawn, keep
            self.rebuild(mesh, keep)
        self.show()

    def rebuild(self, mesh: Mesh, keep: np.ndarray | None) -> None:
        """Build the faces; parameters are those of `draw`."""
        raise NotImplementedError


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
class InterfaceLayer(_MaterialLayer):
    """Draws the faces between materials."""

    colour, edge_opacity = INTERFACE, 0.9

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        self.actors[1].GetProperty().SetLineWidth(_EDGE_WIDTH * pixel_ratio)

    def rebuild(self, mesh: Mesh, keep: np.ndarray | None) -> None:
        faces = mesh.materials.interface_faces
        if keep is not None:
            faces = faces[keep[mesh.materials.interface_sides[:, [0, 2]]].any(axis=1)]
        nodes, quads = np.unique(faces, return_inverse=True)
        self.set_quads(mesh.points[nodes], quads.reshape(faces.shape))

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry if the mesh has several materials."""
        if mesh.materials is None:
            return []
        count = int(np.count_nonzero(mesh.materials.interface_nodes & ~mesh.topology.boundary))
        return [(INTERFACE, True, f"{count:,} inside")]


@layer(
    "materials",
    title="Colour by material",
    help="The visible faces of the hexes in the colour of their material.",
    empty="None: the mesh has one material.",
    action="Colour by &material",
    action_help="Colour the hexes by material: element blocks, element sets, physical volumes, regions.",
    order=94,
)
class ColourByMaterial(_MaterialLayer):
    """Draws the outer faces of shown hexes in one colour for each material."""

    colour, face_opacity, edge_opacity = SHARP, 1.0, 0.5

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        mapper = self.actors[0].GetMapper()
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellData()
        light = self.actors[0].GetProperty()
        light.LightingOn()
        light.SetAmbient(_AMBIENT)
        light.SetDiffuse(_DIFFUSE)

    def rebuild(self, mesh: Mesh, keep: np.ndarray | None) -> None:
        across = mesh.topology.face_neighbours
        outer = across < 0
        if keep is not None:
            outer = keep[:, None] & (outer | ~keep[across])
        hexes, sides = np.nonzero(outer)
        faces = mesh.hexes[hexes[:, None], FACES[sides]]
        nodes, quads = np.unique(faces, return_inverse=True)
        self.set_quads(mesh.points[nodes], quads.reshape(faces.shape))
        if len(hexes):
            table = np.array([rgb(colour) for colour in MATERIAL_COLOURS])
            colours = np.rint(255 * table[mesh.materials.of_hex[hexes] % len(table)]).astype(np.uint8)
            self.poly.cell_data.set_scalars(colours, "colour")

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return an entry for each material, the first `_MAX_NAMED` by name."""
        materials = mesh.materials
        if materials is None:
            return []
        entries: list[LegendEntry] = [
            (MATERIAL_COLOURS[k % len(MATERIAL_COLOURS)], False, _shortened(printable(name)))
            for k, name in enumerate(materials.names[:_MAX_NAMED])
        ]
        more = len(materials) - _MAX_NAMED
        return entries + ([(None, False, f"and {more:,} more")] if more > 0 else [])


def _shortened(name: str) -> str:
    return name if len(name) <= _MAX_LETTERS else f"{name[: _MAX_LETTERS - 1]}…"
