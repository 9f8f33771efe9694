"""Lines and points at nodes of a mesh, with a dark rim that makes them visible on every colour."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.scene.geometry.curved_edges import CurvedEdges
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth

#: Maximum number of marks of one kind that are drawn in full. More are drawn thinner, and paler inside the mesh.
MANY = 1500

_RIM = "#11151c"
_COLOURS = "colours"

#: Depth offsets of marks in front of their surface, in VTK's units: of the rim, and of the mark itself.
_LINE_DEPTHS = (-20.0, -40.0)
_POINT_DEPTHS = (-60.0, -120.0)


class Marks:
    """Marks of one kind in a renderer.

    Attributes
    ----------
    poly : pv.PolyData
        Lines or points, each with a colour.

    Parameters
    ----------
    renderer : vtkRenderer
    size : float
        Full width of lines or side of points, in pixels.
    rim : float
        Width of the dark rim on each side, in pixels.
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, size: float, rim: float, pixel_ratio: float = 1.0):
        self._size, self._rim_width, self._pixel_ratio = size, rim, pixel_ratio
        self.poly = pv.PolyData()
        self._rims, self._filled = (self._actor(renderer, coloured) for coloured in (False, True))
        self.scale(1.0)

    def _actor(self, renderer: vtkRenderer, coloured: bool) -> vtkActor:
        actor = flat_actor(renderer, colour=_RIM)
        mapper = actor.GetMapper()
        mapper.SetScalarVisibility(coloured)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(_COLOURS)
        mapper.SetColorModeToDirectScalars()
        offset_depth(mapper, lines=_LINE_DEPTHS[coloured], points=_POINT_DEPTHS[coloured], slope=-1.0)
        return actor

    @property
    def shown(self) -> bool:
        """True while marks are drawn."""
        return bool(self._filled.GetVisibility())

    @property
    def count(self) -> int:
        """Number of marks."""
        return self.poly.n_cells

    def show(
        self,
        cells: np.ndarray,
        colours: np.ndarray,
        points: np.ndarray,
        opacity: float = 1.0,
        curves: CurvedEdges | None = None,
    ) -> None:
        """Replace the marks.

        Parameters
        ----------
        cells : (k, 2) or (k, 1) int
            Nodes of lines or of points.
        colours : (k, 3) uint8
        points : (n, 3) float64
            Positions of all nodes.
        opacity : float
            Translucent marks have no rims.
        curves : CurvedEdges, optional
            The edges of `cells`, to draw them curved.
        """
        if not len(cells):
            self.hide()
            return
        if curves is None:
            nodes, index = np.unique(cells, return_inverse=True)
            places, index = points[nodes], index.reshape(cells.shape)
        else:
            places, index = curves.places(points), curves.chains
        rows = pv.CellArray.from_regular_cells(index)  # type: ignore[arg-type]
        self.poly = pv.PolyData(places, **{"lines" if index.shape[1] > 1 else "verts": rows})
        self.poly.cell_data[_COLOURS] = colours
        for actor in (self._rims, self._filled):
            actor.GetMapper().SetInputData(self.poly)
            actor.GetProperty().SetOpacity(opacity)
        self._filled.VisibilityOn()
        self._rims.SetVisibility(opacity == 1)

    def scale(self, factor: float) -> None:
        """Scale the marks by a factor from 0 to 1, for dense meshes."""
        size, rim = max(1.0, factor * self._size), max(0.5, factor * self._rim_width)
        for actor, width in ((self._filled, size), (self._rims, size + 2 * rim)):
            actor.GetProperty().SetLineWidth(self._pixel_ratio * width)
            actor.GetProperty().SetPointSize(self._pixel_ratio * width)

    def hide(self) -> None:
        """Hide the marks."""
        self._filled.VisibilityOff()
        self._rims.VisibilityOff()
