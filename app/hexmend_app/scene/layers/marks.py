"""Lines and points on nodes of a mesh, with a dark rim, so that they are visible on every colour."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend_app.scene.layers.surface import set_points
from hexmend_app.theme.palette import rgb

_RIM = "#11151c"
_COLOURS = "colours"

#: How far marks are drawn before the surface that they lie on, in VTK's units of depth: the rim, and what it is around.
_LINES_BEFORE = (-20.0, -40.0)
_POINTS_BEFORE = (-60.0, -120.0)


class Marks:
    """Marks of one kind in one renderer, which follow the nodes.

    Attributes
    ----------
    poly : pv.PolyData
        The lines or points, with a colour each.
    nodes : (k,) int
        Of the mesh, at the points of `poly`.
    filled : vtkActor
        Draws them without their rims.

    Parameters
    ----------
    renderer : vtkRenderer
    size : float
        Width of the lines or side of the points where there is room, in pixels.
    rim : float
        Width of the dark rim on either side, in pixels.
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, size: float, rim: float, pixel_ratio: float = 1.0):
        self._size, self._rim, self._pixel_ratio = size, rim, pixel_ratio
        self.poly = pv.PolyData()
        self.nodes = np.empty(0, np.int64)
        self._around = self._actor(renderer, coloured=False)
        self.filled = self._actor(renderer, coloured=True)
        self.fit(1.0)
        self.hide()

    def _actor(self, renderer: vtkRenderer, coloured: bool) -> vtkActor:
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self.poly)
        mapper.SetScalarVisibility(coloured)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(_COLOURS)
        mapper.SetColorModeToDirectScalars()
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, _LINES_BEFORE[coloured])
        mapper.SetRelativeCoincidentTopologyPointOffsetParameter(_POINTS_BEFORE[coloured])
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.PickableOff()
        actor.GetProperty().SetColor(rgb(_RIM))
        actor.GetProperty().LightingOff()
        renderer.AddActor(actor)
        return actor

    @property
    def shown(self) -> bool:
        """True while something is drawn."""
        return bool(self.filled.GetVisibility())

    @property
    def count(self) -> int:
        """Number of marks that are drawn."""
        return self.poly.n_cells

    def show(self, cells: np.ndarray, colours: np.ndarray, points: np.ndarray, opacity: float = 1.0) -> None:
        """Draw other marks.

        Parameters
        ----------
        cells : (k, 2) or (k, 1) int
            Nodes of lines, or of points.
        colours : (k, 3) uint8
        points : (n, 3) float64
            Of all nodes.
        opacity : float
        """
        if not len(cells):
            self.hide()
            return
        self.nodes, places = np.unique(cells, return_inverse=True)
        width = cells.shape[1]
        rows = np.column_stack([np.full(len(cells), width), places.reshape(cells.shape)]).ravel()
        self.poly = pv.PolyData(points[self.nodes], **{"lines" if width == 2 else "verts": rows})
        self.poly.cell_data[_COLOURS] = colours
        for actor in (self._around, self.filled):
            actor.GetMapper().SetInputData(self.poly)
            actor.GetProperty().SetOpacity(opacity)
        self.filled.VisibilityOn()
        self.show_rims(True)

    def show_rims(self, on: bool) -> None:
        """Draw the rims or not; translucent marks never have any."""
        self._around.SetVisibility(on and self.shown and self.filled.GetProperty().GetOpacity() == 1)

    def move(self, points: np.ndarray) -> None:
        """Move with the nodes, (n, 3) float64."""
        if self.shown:
            set_points(self.poly, points[self.nodes])

    def fit(self, share: float) -> None:
        """Scale the marks by a factor from 0 to 1, for dense meshes."""
        size, rim = max(1.0, share * self._size), max(0.5, share * self._rim)
        for actor, width in ((self.filled, size), (self._around, size + 2 * rim)):
            actor.GetProperty().SetLineWidth(self._pixel_ratio * width)
            actor.GetProperty().SetPointSize(self._pixel_ratio * width)

    def hide(self) -> None:
        """Draw nothing."""
        self.filled.VisibilityOff()
        self._around.VisibilityOff()
