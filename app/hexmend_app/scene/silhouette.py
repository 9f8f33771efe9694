"""What a part of a mesh was cut from, kept in mind: the whole body's sharp edges, or the shape of its inside."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh import Mesh
from hexmend_app.scene.surface import set_points
from hexmend_app.state.theme import SHADE, SILHOUETTE

#: Neighbouring faces whose normals differ by more than this, in degrees, meet in a sharp edge.
_SHARP = 30.0

#: Of the ends of sharp edges; where more belong to one sharp edge alone, a round body has facets that are sharp here
#: and there, and what they give is a heap of splinters. Sharp edges of a body with corners go on at either end.
_MOST = 0.2

#: How far the shade is drawn behind its place, in VTK's units: behind everything.
_BEHIND = 66_000.0


def sharp_edges(points: np.ndarray, faces: np.ndarray, degrees: float = _SHARP) -> np.ndarray:
    """Edges in which two faces meet at an angle, or one or more than two faces meet at all, (e, 2) of nodes.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) int32
        All counter-clockwise from the same side.
    degrees : float
        Angle between the normals of two faces beyond which their edge is sharp.
    """
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    key = edges[:, 0].astype(np.int64) * len(points) + edges[:, 1]
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    count = np.diff(first, append=len(key))
    corners = points[faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    pair = order[first] // 4, order[np.minimum(first + 1, len(key) - 1)] // 4
    turned = np.einsum("ij,ij->i", normals[pair[0]], normals[pair[1]]) < np.cos(np.radians(degrees))
    return edges[order[first[turned | (count != 2)]]]


def form_lines(edges: np.ndarray) -> bool:
    """Whether edges, (e, 2), go on into each other, so that a body can be recognised by them."""
    ends = np.unique(edges, return_counts=True)[1]
    return len(edges) > 0 and (ends == 1).sum() <= _MOST * len(ends)


class Silhouette:
    """Draws the sharp edges of a mesh's boundary as thin lines, and a round body as a shade behind what is left of it.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
    mesh : Mesh
        Its boundary is drawn where its nodes are; `move` says where they go.
    """

    def __init__(self, plotter: pv.BasePlotter, mesh: Mesh):
        faces = mesh.topology.boundary_faces
        edges = sharp_edges(mesh.points, faces)
        self._lines = lines = form_lines(edges)
        cells = edges if lines else faces
        self._nodes, places = np.unique(cells, return_inverse=True)
        places = places.reshape(cells.shape)
        points = mesh.points[self._nodes]
        if lines:
            self._poly = pv.PolyData(points, lines=np.column_stack([np.full(len(places), 2), places]).ravel())
        else:
            self._poly = pv.PolyData.from_regular_faces(points, places)
        self._actor = plotter.add_mesh(
            self._poly if len(cells) else pv.PolyData(np.zeros((1, 3))),
            name="outline",
            line_width=1,
            lighting=False,
            culling=None if lines else "back",
            reset_camera=False,
            pickable=False,
            render=False,
        )
        if not lines:
            mapper = self._actor.mapper
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, _BEHIND)
        self.set_dark(False)
        self.show(False)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark ground, or for the light one."""
        self._actor.prop.color = (SILHOUETTE if self._lines else SHADE).of(dark)

    def show(self, on: bool) -> None:
        """Draw it or not."""
        self._actor.SetVisibility(on)

    def move(self, points: np.ndarray) -> None:
        """Take the nodes' places, (n, 3) float64; of a boundary that is fixed, nothing is sent to be drawn anew."""
        places = points[self._nodes]
        if not np.array_equal(places, self._poly.points):
            set_points(self._poly, places)
