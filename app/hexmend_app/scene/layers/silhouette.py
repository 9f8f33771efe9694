"""What a part of a mesh was cut from, kept in mind: the whole body's sharp edges, or the shape of its inside."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh import Mesh
from hexmend.structure import sharp_edges
from hexmend_app.scene.layers.surface import set_points
from hexmend_app.scene.palette import SHADE, SILHOUETTE

#: Of the ends of sharp edges; where more belong to one sharp edge alone, a round body has facets that are sharp here
#: and there, and what they give is a heap of splinters. Sharp edges of a body with corners go on at either end.
_MOST = 0.2

#: How far the shade is drawn behind its place, in VTK's units: behind everything.
_BEHIND = 66_000.0


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
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, plotter: pv.BasePlotter, mesh: Mesh, pen: float = 1.0):
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
            line_width=pen,
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
