"""Outer faces of tetrahedra, pyramids and wedges of the mesh, grey and translucent."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.coloured_polygons import set_points
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.polygons import surface_of
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.theme.palette import OTHER_CELLS

#: Name of the point data with the nodes of the mesh.
_NODE = "node"


@layer(
    "others",
    title="Other cells",
    help="Outer faces of tetrahedra, pyramids and wedges, translucent. Their nodes are fixed.",
    empty="None: the mesh consists of hexes only.",
    action="Other c&ells",
    action_help="Show tetrahedra, pyramids and wedges, grey and translucent.",
    keys="G",
    order=80,
    hidden_when_empty=True,
)
class OtherCells(TranslucentSurface, OptionalLayer):
    """Draws the faces of non-hexahedral cells that no other cell shares.

    A cut hides the cells whose centres it removes.
    """

    colour, edge_opacity = OTHER_CELLS, 0.4

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        self._drawn: tuple[Mesh | None, Cut] = (None, Cut())

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the cells of a frame; an unchanged surface is not rebuilt, but moves with its nodes."""
        mesh, cut = frame.mesh, frame.look.cut.with_hexes(None)
        if not any(cells.dimension == 3 for cells in mesh.cells):
            self.hide()
            return
        last, last_cut = self._drawn
        if last is None or last.cells is not mesh.cells or last.hexes is not mesh.hexes or last_cut != cut:
            self.set_data(outer_faces(mesh, cut))
        elif last.points is not mesh.points:
            set_points(self.poly, mesh.points[self.poly.point_data[_NODE]])
        self._drawn = mesh, cut
        self.show()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry for each cell type, with the number of cells."""
        return [
            (OTHER_CELLS, False, f"{len(cells.nodes):,} {cells.kind}") for cells in mesh.cells if cells.dimension == 3
        ]


def outer_faces(mesh: Mesh, cut: Cut | None = None) -> pv.PolyData:
    """Return the faces of non-hexahedral cells that no other cell shares; point data have the node of each point.

    Parameters
    ----------
    mesh : Mesh
    cut : Cut, optional
        Omits the cells whose centre it cuts away, which exposes faces of their neighbours.
    """
    # Hexes at the boundary, without their own faces: only these can share faces with other cells.
    parts: dict[int, list[np.ndarray]] = {
        pv.CellType.HEXAHEDRON: [mesh.hexes[(mesh.topology.face_neighbours < 0).any(axis=1)]]
    }
    for cells in mesh.cells:
        if cells.dimension == 3:
            straight = CELL_KINDS[cells.kind.rstrip("0123456789")]
            nodes = cells.nodes[:, : straight.nodes]
            left = slice(None) if cut is None else ~cut.hidden(mesh.points[nodes].mean(axis=1))
            parts.setdefault(straight.vtk, []).append(nodes[left])
    grid = pv.UnstructuredGrid({kind: np.concatenate(nodes) for kind, nodes in parts.items()}, mesh.points)
    grid.cell_data["kind"], grid.point_data[_NODE] = grid.celltypes, np.arange(mesh.n_nodes)
    surface = surface_of(grid)
    return surface_of(surface.extract_cells(surface.cell_data["kind"] != pv.CellType.HEXAHEDRON))
