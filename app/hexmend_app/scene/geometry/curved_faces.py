"""Curved faces of second-order hexes, divided into small quads for drawing."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pyvista as pv

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order.curved_geometry import evaluate_quads, grid, quad_nodes
from hexmend.mesh.second_order.mid_node_lookup import face_mid_nodes
from hexmend.mesh.solid_cells import centres
from hexmend_app.scene.geometry.coloured_polygons import coloured, set_colours, set_points
from hexmend_app.scene.geometry.curved_elements import quad_normals
from hexmend_app.scene.geometry.edge_flags import NORMALS, set_edge_flags, set_normals
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.state.mesh.inspection import all_mid_nodes

#: Maximum number of quads into which the faces are divided together, as far as each face has at least four; they take
#: 30 ms a frame in software rendering.
MAX_QUADS = 20_000

#: Largest number of divisions of an edge, and largest number of faces that are divided; of more faces, the bend of each
#: is less than a pixel.
_MAX_DIVISIONS, MAX_FACES = 8, 60_000


def divisions_of(faces: int) -> int:
    """Return the number of divisions of the edges of curved faces, by their number; 1 draws them flat.

    >>> [divisions_of(faces) for faces in (1, 300, 1200, 5800, 100_000)]
    [8, 8, 4, 2, 1]
    """
    if faces > MAX_FACES:
        return 1
    return min(max(math.isqrt(MAX_QUADS // max(faces, 1)), 2), _MAX_DIVISIONS)


class CurvedFaces:
    """Divides curved faces into quads.

    Parameters
    ----------
    mesh : Mesh
        Mesh with mid-nodes; its positions are not used.
    faces : Faces
        Faces of hexes by their corners.
    divisions : int
        Number of divisions of each edge.
    """

    def __init__(self, mesh: Mesh, faces: Faces, divisions: int):
        self.divisions = divisions
        self._hexes, self._shrink = faces.hexes, faces.shrink
        self._corners = faces.nodes[faces.quads]
        self._mids = face_mid_nodes(mesh.elements, all_mid_nodes(mesh), faces.hexes, self._corners)
        self._of_hexes = mesh.elements[faces.hexes] if faces.shrink else None

    @property
    def count(self) -> int:
        """Number of faces."""
        return len(self._corners)

    def nodes(self, points: np.ndarray) -> np.ndarray:
        """Return the drawn positions of the nine nodes of each face, (k, 9, 3), from the points of the mesh, (n, 3)."""
        nodes = quad_nodes(points, self._corners, self._mids)
        if self._shrink:
            nodes += self._shrink * (centres(points, self._of_hexes)[:, None] - nodes)
        return nodes

    def quads(self, points: np.ndarray, colours: np.ndarray) -> pv.PolyData:
        """Build the quads of all faces, face by face.

        Parameters
        ----------
        points : (n, 3) float64
            Points of the mesh.
        colours : (k, 3) uint8
            Colours of the faces.
        """
        places, normals = self._evaluated(points)
        cells: np.ndarray = np.arange(len(places)).reshape(-1, 4)
        poly = pv.PolyData.from_regular_faces(places, cells)
        if len(places):
            set_normals(poly, normals)
            set_edge_flags(poly, np.tile(_pieces(self.divisions)[1], len(self._corners)))
        return coloured(poly, self._repeated(colours), self._repeated(self._hexes))

    def move(self, poly: pv.PolyData, points: np.ndarray, colours: np.ndarray | None = None) -> None:
        """Move the quads that `quads` built, and colour them if there are colours; parameters are those of `quads`."""
        if not len(self._corners):
            return
        places, normals = self._evaluated(points)
        poly.point_data[NORMALS][:] = normals  # type: ignore[index]
        poly.GetPointData().GetArray(NORMALS).Modified()
        set_points(poly, places)
        if colours is not None:
            set_colours(poly, self._repeated(colours))

    def _evaluated(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return points and normals of the corners of all quads, (4 k divisions^2, 3) each."""
        nodes, at = self.nodes(points), _pieces(self.divisions)[0]
        return evaluate_quads(nodes, at).reshape(-1, 3), quad_normals(nodes, at).astype(np.float32).reshape(-1, 3)

    def _repeated(self, of_faces: np.ndarray) -> np.ndarray:
        return np.repeat(of_faces, self.divisions**2, axis=0)


@cache
def _pieces(divisions: int) -> tuple[np.ndarray, np.ndarray]:
    """Return positions of the corners of the quads of a face, (4 divisions^2, 2), and True where its edges begin."""
    column, row = np.meshgrid(np.arange(divisions), np.arange(divisions), indexing="xy")
    first = row * (divisions + 1) + column
    index = np.stack([first, first + 1, first + divisions + 2, first + divisions + 1], axis=-1)
    last = divisions - 1
    flags = np.stack([row == 0, column == last, row == last, column == 0], axis=-1)
    return grid(divisions)[index.ravel()], flags.ravel()
