"""Sharp edges and outline of the whole mesh, for orientation while part of it is hidden."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.cutting.cut import remaining_points
from hexmend_app.scene.geometry.coloured_polygons import set_points
from hexmend_app.scene.geometry.curved_edges import CurvedEdges, segments, sharp_curved_edges
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import edges_of_kept
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
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
    lines is drawn as a shade behind its visible part instead; a shade is flat.

    Attributes
    ----------
    poly : pv.PolyData
        Pale lines or shade of the whole mesh.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.actor, self._sharp = (flat_actor(pane.renderer, width * pixel_ratio) for width in (1.0, _BOLD))
        offset_depth(self._sharp.GetMapper(), lines=_IN_FRONT, polygons=_IN_FRONT)
        self.poly = pv.PolyData()
        self._frame: Frame | None = None
        self._dark = self._lines = False
        self._curves: CurvedEdges | None = None

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._dark = dark
        self.actor.GetProperty().SetColor(rgb((SILHOUETTE if self._lines else SHADE).of(dark)))
        self._sharp.GetProperty().SetColor(rgb(SHARP.of(dark)))

    def hide(self) -> None:
        """Hide the outline."""
        self.actor.SetVisibility(False)
        self._sharp.SetVisibility(False)

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the outline of the mesh of a frame.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        """
        if not frame.is_of(self._frame) or frame.curved != self._frame.curved:
            self._set_mesh(frame)
        self._frame, look = frame, frame.look
        places = self._places(frame.mesh.points)
        if not np.array_equal(places, self.poly.points):  # a fixed boundary is not uploaded again
            set_points(self.poly, places)
        self.actor.SetVisibility(look.show.outline and (keep is not None or look.cut.active))
        self._sharp.SetVisibility(False)
        if self._lines and look.show.outline and not look.show.shrink:  # shrunk hexes do not touch the edges
            middles = frame.mesh.points[self._edges].mean(axis=1)
            shown = edges_of_kept(frame.mesh, self._edges, keep) & remaining_points(middles, look.cut)
            self._sharp.SetVisibility(bool(shown.any()))
            lines = pv.PolyData()
            lines.SetPoints(self.poly.GetPoints())
            lines.SetLines(_lines(self._cells[shown]))
            self._sharp.GetMapper().SetInputData(lines)

    def _set_mesh(self, frame: Frame) -> None:
        mesh, faces = frame.mesh, frame.mesh.topology.boundary_faces
        self._edges = edges = sharp_curved_edges(mesh) if frame.curved else sharp_edges(mesh.points, faces)
        self._lines = form_lines(edges)
        self._curves = CurvedEdges(mesh, edges) if frame.curved and self._lines else None
        cells = edges if self._lines else faces
        self._nodes, index = np.unique(cells, return_inverse=True)
        self._cells = index.reshape(cells.shape) if self._curves is None else self._curves.chains
        points = self._places(mesh.points)
        if self._lines:
            self.poly = pv.PolyData(points, lines=_lines(self._cells))
        else:
            self.poly = pv.PolyData.from_regular_faces(points, self._cells)  # type: ignore[arg-type]
        self.actor.GetMapper().SetInputData(self.poly)
        self.actor.GetProperty().SetBackfaceCulling(not self._lines)
        offset_depth(self.actor.GetMapper(), lines=0.0, polygons=_BEHIND)
        self.set_dark(self._dark)

    def _places(self, points: np.ndarray) -> np.ndarray:
        """Return the drawn points, (k, 3), from the positions of the nodes."""
        return points[self._nodes] if self._curves is None else self._curves.places(points)


def _lines(chains: np.ndarray) -> pv.CellArray:
    """Return lines from the point numbers of lines or chains of lines, (e, 2) or more columns."""
    return pv.CellArray.from_regular_cells(chains if chains.shape[1] == 2 else segments(chains))
