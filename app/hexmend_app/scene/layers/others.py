"""Cells beside the hexes that fill space, tetrahedra, pyramids and wedges: their outer skin, grey and see-through."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.see_through import SeeThrough
from hexmend_app.scene.palette import OTHER_CELLS, rgb
from hexmend_app.state.clip import Clip

#: How strongly their edges are drawn.
_EDGES = 0.4

#: Corners of the faces of each kind; those of second order have the same. Which side is outside does not matter.
FACES = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 1, 2), (5, 4, 3), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
}


class OtherCells:
    """Draws the faces of those cells that no other cell and no hex shares.

    Where a clip cuts the mesh, cells are left out whose centres are cut away.

    Parameters
    ----------
    renderer : vtkRenderer
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, renderer: vtkRenderer, pen: float = 1.0):
        self._drawn: tuple[Mesh | None, Clip | None] = (None, None)
        self._nodes = np.empty(0, np.int64)
        self._lines = pv.PolyData()
        self._skin = SeeThrough(renderer, pen, _EDGES)
        self.set_dark(False)

    @property
    def poly(self) -> pv.PolyData:
        """What is drawn."""
        return self._skin.poly

    @property
    def shown(self) -> bool:
        """Whether any are drawn."""
        return self._skin.shown

    @property
    def places(self) -> np.ndarray:
        """Their corners, (k, 3); none where none is drawn."""
        return self._skin.places

    def hide(self) -> None:
        """Draw nothing."""
        self._skin.show(False)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark ground, or for the light one."""
        self._skin.set_colour(rgb(OTHER_CELLS.of(dark)))

    def draw(self, frame: Frame) -> None:
        """Draw what a frame wants of them; what is drawn already stays, or moves with its nodes."""
        on = frame.look.structure.others and any(cells.dimension == 3 for cells in frame.mesh.cells)
        if on:
            mesh, clip = frame.mesh, frame.look.clip
            last, cut = self._drawn
            if last is None or last.cells is not mesh.cells or last.hexes is not mesh.hexes or cut != clip:
                self._take(mesh, clip)
            elif last.points is not mesh.points and self.poly.n_cells:
                self._place(mesh.points[self._nodes])
            self._drawn = mesh, clip
        self._skin.show(on)

    def _take(self, mesh: Mesh, clip: Clip | None) -> None:
        faces = outer_faces(mesh, clip)
        ends = [np.sort(np.stack([one, np.roll(one, 1, axis=1)], axis=-1).reshape(-1, 2), axis=1) for one in faces]
        edges = np.unique(np.concatenate(ends), axis=0)
        self._nodes = np.unique(edges)
        self._lines = pv.PolyData()
        self._skin.take(pv.PolyData(), self._lines)
        if not len(edges):
            return
        self._place(mesh.points[self._nodes])
        self.poly.faces = np.concatenate([_with_lengths(np.searchsorted(self._nodes, one)) for one in faces])
        self._lines.lines = _with_lengths(np.searchsorted(self._nodes, edges))

    def _place(self, points: np.ndarray) -> None:
        self.poly.points = points
        self._lines.SetPoints(self.poly.GetPoints())


def outer_faces(mesh: Mesh, clip: Clip | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (k, 3) and quadrilaterals (l, 4) of cells beside the hexes that no other cell and no hex shares.

    Parameters
    ----------
    mesh : Mesh
    clip : PlaneClip or BoxClip, optional
        Cells whose centre it cuts away are left out, and count as not there.
    """
    found: dict[int, list[np.ndarray]] = {3: [], 4: []}
    for cells in mesh.cells:
        if cells.dimension == 3:
            nodes = cells.nodes[_uncut(mesh.points, cells, clip)]
            for face in FACES[cells.kind.rstrip("0123456789")]:
                found[len(face)].append(nodes[:, face])
    triangles, quads = (
        np.concatenate([np.empty((0, width), np.int64), *found[width]]).astype(np.int64) for width in (3, 4)
    )
    return _single(triangles, triangles[:0]), _single(quads, mesh.topology.boundary_faces)


def _single(faces: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Those of some faces that occur once, and not among those of hexes."""
    rows = np.sort(np.concatenate([faces, hexes]), axis=1)
    _, which, counts = np.unique(rows, axis=0, return_inverse=True, return_counts=True)
    return faces[counts[which.ravel()[: len(faces)]] == 1]


def _uncut(points: np.ndarray, cells: Cells, clip: Clip | None) -> np.ndarray:
    if clip is None:
        return np.ones(len(cells.nodes), bool)
    centres = points[cells.nodes].mean(axis=1)
    beyond = np.stack([plane.signed_distance(centres) > 0 for plane in clip.planes])
    return ~(beyond.all(axis=0) if clip.notch else beyond.any(axis=0))


def _with_lengths(rows: np.ndarray) -> np.ndarray:
    """Rows as VTK keeps cells, each behind its length, flat."""
    return np.column_stack([np.full(len(rows), rows.shape[1]), rows]).ravel()
