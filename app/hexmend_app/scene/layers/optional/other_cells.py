"""Outer faces of tetrahedra, pyramids and wedges of the mesh, grey and translucent."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface, edges_of
from hexmend_app.theme.palette import OTHER_CELLS

#: Corners of the faces of each cell type, also of second order, in any orientation.
FACES = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 1, 2), (5, 4, 3), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
}


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
        self._nodes = np.empty(0, np.int64)
        self._lines = pv.PolyData()

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the cells of a frame; an unchanged surface is not rebuilt, but moves with its nodes."""
        mesh, cut = frame.mesh, frame.look.cut.with_hexes(None)
        if not any(cells.dimension == 3 for cells in mesh.cells):
            self.hide()
            return
        last, last_cut = self._drawn
        if last is None or last.cells is not mesh.cells or last.hexes is not mesh.hexes or last_cut != cut:
            self._build(mesh, cut)
        elif last.points is not mesh.points and self.poly.n_cells:
            self._move(mesh.points[self._nodes])
        self._drawn = mesh, cut
        self.show()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return one entry for each cell type, with the number of cells."""
        return [
            (OTHER_CELLS, False, f"{len(cells.nodes):,} {cells.kind}") for cells in mesh.cells if cells.dimension == 3
        ]

    def _build(self, mesh: Mesh, cut: Cut) -> None:
        faces = outer_faces(mesh, cut)
        edges = edges_of(*faces)
        self._nodes = np.unique(edges)
        self._lines = pv.PolyData()
        self.set_data(pv.PolyData(), self._lines)
        if not len(edges):
            return
        self._move(mesh.points[self._nodes])
        self.poly.faces = pv.CellArray.from_irregular_cells(
            [row for polygons in faces for row in np.searchsorted(self._nodes, polygons)]
        )
        self._lines.lines = pv.CellArray.from_regular_cells(np.searchsorted(self._nodes, edges))  # type: ignore[arg-type]

    def _move(self, points: np.ndarray) -> None:
        self.poly.points = points
        self._lines.SetPoints(self.poly.GetPoints())


def outer_faces(mesh: Mesh, cut: Cut | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Return triangles, (k, 3), and quads, (l, 4), of non-hexahedral cells that no other cell shares.

    Parameters
    ----------
    mesh : Mesh
    cut : Cut, optional
        Omits the cells whose centre it cuts away, which exposes faces of their neighbours.
    """
    found: dict[int, list[np.ndarray]] = {3: [], 4: []}
    for cells in mesh.cells:
        if cells.dimension == 3:
            nodes = cells.nodes[_uncut(mesh.points, cells, cut)]
            for face in FACES[cells.kind.rstrip("0123456789")]:
                found[len(face)].append(nodes[:, face])
    triangles, quads = (
        np.concatenate([np.empty((0, width), np.int64), *found[width]]).astype(np.int64) for width in (3, 4)
    )
    return _single(triangles, triangles[:0]), _single(quads, mesh.topology.boundary_faces)


def _single(faces: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Return the faces, (k, corners), that occur once and are not among the faces of hexes."""
    rows = np.sort(np.concatenate([faces, hexes]), axis=1)
    _, group, counts = np.unique(rows, axis=0, return_inverse=True, return_counts=True)
    return faces[counts[group.ravel()[: len(faces)]] == 1]


def _uncut(points: np.ndarray, cells: Cells, cut: Cut | None) -> np.ndarray:
    if cut is None or not cut.active:
        return np.ones(len(cells.nodes), bool)
    return ~cut.hidden(points[cells.nodes].mean(axis=1))
