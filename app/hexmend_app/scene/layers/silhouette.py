"""Sharp edges and silhouette of the whole body, for orientation while a part of the mesh is hidden."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkMapper, vtkRenderer

from hexmend.kernels import skin
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.structure import sharp_edges
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.scene.layers.optional.structure import uncut
from hexmend_app.scene.layers.surface import set_points
from hexmend_app.theme.palette import SHADE, SHARP, SILHOUETTE, rgb

#: Of the ends of sharp edges; where more belong to one sharp edge alone, a round body has facets that are sharp here
#: and there, and what they give is a heap of splinters. Sharp edges of a body with corners go on at either end.
_MOST = 0.2

#: How far the shade is drawn behind its place, in VTK's units: behind everything; and sharp edges before theirs.
_BEHIND, _BEFORE = 66_000.0, -6.0

#: Width of sharp edges, in thin lines.
_BOLD = 1.75


def form_lines(edges: np.ndarray) -> bool:
    """Return True if edges, (e, 2), form lines, so that they show the shape of a body."""
    ends = np.unique(edges, return_counts=True)[1]
    return len(edges) > 0 and (ends == 1).sum() <= _MOST * len(ends)


class Silhouette:
    """Draws the sharp edges of the boundary, and the outline of the whole mesh.

    Sharp edges of what is shown are dark lines, those of what is hidden are pale. A round body has none that go on
    into each other: it is a shade behind what is left of it.

    Attributes
    ----------
    actor : vtkActor
        Draws what was cut from.

    Parameters
    ----------
    renderer : vtkRenderer
    mesh : Mesh
        Its boundary is drawn where its nodes are; `move` says where they go.
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, mesh: Mesh, pixel_ratio: float = 1.0):
        self._mesh, faces = mesh, mesh.topology.boundary_faces
        self._edges = edges = sharp_edges(mesh.points, faces)
        self._lines = lines = form_lines(edges)
        cells = edges if lines else faces
        self._nodes, places = np.unique(cells, return_inverse=True)
        self._places = places = places.reshape(cells.shape)
        points = mesh.points[self._nodes]
        self._poly = _lines(points, places) if lines else pv.PolyData.from_regular_faces(points, places)
        self._renderer = renderer
        self.actor, self._sharp = flat_actor(renderer, pixel_ratio), flat_actor(renderer, _BOLD * pixel_ratio)
        self.actor.GetMapper().SetInputData(self._poly)
        _offset(self._sharp.GetMapper(), _BEFORE, _BEFORE)
        if not lines:
            self.actor.GetProperty().BackfaceCullingOn()
            _offset(self.actor.GetMapper(), 0.0, _BEHIND)
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark theme, or for the light one."""
        self.actor.GetProperty().SetColor(rgb((SILHOUETTE if self._lines else SHADE).of(dark)))
        self._sharp.GetProperty().SetColor(rgb(SHARP.of(dark)))

    def hide(self) -> None:
        """Draw nothing."""
        self.actor.SetVisibility(False)
        self._sharp.SetVisibility(False)

    def show(self, look: Look, points: np.ndarray, keep: np.ndarray | None) -> None:
        """Draw the outline as a look selects it.

        Parameters
        ----------
        look : Look
        points : (n, 3) float64
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part; None for all.
        """
        self.move(points)
        shown = self._shown(look, points, keep) if look.outline and self._lines else np.zeros(0, bool)
        self.actor.SetVisibility(look.outline and (keep is not None or look.clip is not None))
        self._sharp.SetVisibility(bool(shown.any()))
        if shown.any():
            lines = _lines(self._poly.points, self._places[shown])
            lines.SetPoints(self._poly.GetPoints())  # which move
            self._sharp.GetMapper().SetInputData(lines)

    def _shown(self, look: Look, points: np.ndarray, keep: np.ndarray | None) -> np.ndarray:
        """Return True for the sharp edges of shown hexes before a smooth cut, (e,) bool."""
        answer = np.ones(len(self._edges), bool)
        if look.shrink:
            return ~answer  # elements are drawn aside of them
        if keep is not None:
            rows = self._mesh.topology.node_corners
            skin.edges_kept(self._mesh.hexes, rows.start, rows.items, self._edges, keep, answer)
        return answer & uncut(look, points[self._edges].mean(axis=1))

    def move(self, points: np.ndarray) -> None:
        """Move with the nodes, (n, 3) float64; a fixed boundary is not uploaded again."""
        places = points[self._nodes]
        if not np.array_equal(places, self._poly.points):
            set_points(self._poly, places)

    def close(self) -> None:
        """Remove the outline."""
        for actor in (self.actor, self._sharp):
            self._renderer.RemoveActor(actor)


def _lines(points: np.ndarray, ends: np.ndarray) -> pv.PolyData:
    """Build lines between points, (k, 3), by their ends, (e, 2)."""
    return pv.PolyData(points, lines=np.column_stack([np.full(len(ends), 2), ends]).ravel())


def _offset(mapper: vtkMapper, lines: float, polygons: float) -> None:
    """Offset the depth of an actor to the front or the back."""
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, lines)
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, polygons)
