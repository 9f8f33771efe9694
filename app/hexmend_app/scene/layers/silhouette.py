"""Sharp edges and outline of the whole mesh, for orientation while part of it is hidden."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.kernels import skin
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.geometry.coloured_polygons import set_points
from hexmend_app.scene.geometry.curved_edges import CurvedEdges, segments, sharp_curved_edges
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
from hexmend_app.scene.layers.optional.structure import points_kept_by_cut
from hexmend_app.state.mesh.structure import sharp_edges
from hexmend_app.theme.palette import SHADE, SHARP, SILHOUETTE, rgb

#: Maximum fraction of nodes at which a single sharp edge ends, if sharp edges form lines. The facets of a coarse round
#: body have isolated sharp edges, which do not show its shape; sharp edges of a body with corners are connected.
_MAX_LOOSE = 0.2

#: Depth offsets in VTK's units: of the shade, behind everything; of sharp edges, in front of the surface.
_BEHIND, _IN_FRONT = 66_000.0, -6.0

#: Width of sharp edges, in widths of a thin line.
_BOLD = 1.75


def form_lines(edges: np.ndarray) -> bool:
    """Return True if edges, (e, 2), form lines, so that they show the shape of a body."""
    edges_at_node = np.unique(edges, return_counts=True)[1]
    return len(edges) > 0 and (edges_at_node == 1).sum() <= _MAX_LOOSE * len(edges_at_node)


class Silhouette:
    """Draws the sharp edges of the boundary, and the outline of the whole mesh.

    Sharp edges of shown hexes are dark lines, those of hidden hexes are pale. A body whose sharp edges do not form
    lines is drawn as a shade behind its visible part instead.

    Attributes
    ----------
    actor : vtkActor
        Pale lines or shade of the whole mesh.
    curved : bool

    Parameters
    ----------
    renderer : vtkRenderer
    mesh : Mesh
        Mesh whose boundary is drawn; `move` updates positions of its nodes.
    pixel_ratio : float
        Width of a thin line, in pixels.
    curved : bool
        Draw lines curved along the mid-nodes of the mesh; a shade is flat.
    """

    def __init__(self, renderer: vtkRenderer, mesh: Mesh, pixel_ratio: float = 1.0, curved: bool = False):
        self._mesh, faces = mesh, mesh.topology.boundary_faces
        self.curved = curved
        self._edges = edges = sharp_curved_edges(mesh) if curved else sharp_edges(mesh.points, faces)
        self._lines = lines = form_lines(edges)
        self._curves = CurvedEdges(mesh, edges) if curved and lines else None
        cells = edges if lines else faces
        self._nodes, index = np.unique(cells, return_inverse=True)
        self._cells = cells = index.reshape(cells.shape) if self._curves is None else self._curves.chains
        points = self._places(mesh.points)
        self._poly = _lines(points, cells) if lines else pv.PolyData.from_regular_faces(points, cells)  # type: ignore[arg-type]
        self._renderer = renderer
        self.actor, self._sharp = flat_actor(renderer, pixel_ratio), flat_actor(renderer, _BOLD * pixel_ratio)
        self.actor.GetMapper().SetInputData(self._poly)
        offset_depth(self._sharp.GetMapper(), lines=_IN_FRONT, polygons=_IN_FRONT)
        if not lines:
            self.actor.GetProperty().BackfaceCullingOn()
            offset_depth(self.actor.GetMapper(), lines=0.0, polygons=_BEHIND)
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self.actor.GetProperty().SetColor(rgb((SILHOUETTE if self._lines else SHADE).of(dark)))
        self._sharp.GetProperty().SetColor(rgb(SHARP.of(dark)))

    def hide(self) -> None:
        """Hide the outline."""
        self.actor.SetVisibility(False)
        self._sharp.SetVisibility(False)

    def show(self, look: Look, points: np.ndarray, keep: np.ndarray | None) -> None:
        """Draw the outline according to a look.

        Parameters
        ----------
        look : Look
        points : (n, 3) float64
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        """
        self.move(points)
        shown = self._shown(look, points, keep) if look.show.outline and self._lines else np.zeros(0, bool)
        self.actor.SetVisibility(look.show.outline and (keep is not None or look.cut.active))
        self._sharp.SetVisibility(bool(shown.any()))
        if shown.any():
            lines = _lines(self._poly.points, self._cells[shown])
            lines.SetPoints(self._poly.GetPoints())  # share the points, which `move` updates
            self._sharp.GetMapper().SetInputData(lines)

    def _shown(self, look: Look, points: np.ndarray, keep: np.ndarray | None) -> np.ndarray:
        """Return True for sharp edges of shown hexes that a smooth cut leaves, (e,) bool."""
        mask = np.ones(len(self._edges), bool)
        if look.show.shrink:
            return ~mask  # the drawn hexes do not touch them
        if keep is not None:
            rows = self._mesh.topology.node_corners
            skin.edges_kept(self._mesh.hexes, rows.start, rows.items, self._edges, keep, mask)
        return mask & points_kept_by_cut(look, points[self._edges].mean(axis=1))

    def move(self, points: np.ndarray) -> None:
        """Move to the positions of the nodes, (n, 3) float64; a fixed boundary is not uploaded again."""
        moved = self._places(points)
        if not np.array_equal(moved, self._poly.points):
            set_points(self._poly, moved)

    def _places(self, points: np.ndarray) -> np.ndarray:
        """Return the drawn points, (k, 3), from the positions of the nodes."""
        return points[self._nodes] if self._curves is None else self._curves.places(points)

    def close(self) -> None:
        """Remove the actors from the renderer."""
        for actor in (self.actor, self._sharp):
            self._renderer.RemoveActor(actor)


def _lines(points: np.ndarray, chains: np.ndarray) -> pv.PolyData:
    """Build lines from points, (k, 3), and the point numbers of lines or chains of lines, (e, 2) or more columns."""
    ends = chains if chains.shape[1] == 2 else segments(chains)
    return pv.PolyData(points, lines=pv.CellArray.from_regular_cells(ends))
