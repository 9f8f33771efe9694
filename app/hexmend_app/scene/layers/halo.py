"""A light line with a dark rim around each inverted element that is seen: found by more than its colour."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray

from hexmend_app.scene.colours import INVERTED
from hexmend_app.scene.layers.surface import colours_of

# Colour, width in pixels, and how far before the surface, in VTK's units of depth: the light line before its rim. Light
# stands out from the dark end of every map and from magenta, dark from the light end; the dark is a magenta too, so
# that elements no larger than their outlines still look alike.
_LINES = (("#4a062b", 3.0, -4.0), ("#ffffff", 1.5, -8.0))


class Halo:
    """Outlines the inverted elements of one surface.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
    name : str
    """

    def __init__(self, plotter: pv.BasePlotter, name: str):
        self._lines = pv.PolyData()
        self._actors = [_actor(plotter, f"{name} {k}", *line) for k, line in enumerate(_LINES)]
        self.hide()

    def follow(self, poly: pv.PolyData) -> None:
        """Outline what has the colour of inverted elements among polygons that carry their colours.

        The points are shared: as they move, the outlines move along.
        """
        ends = _edges(poly, (colours_of(poly) == INVERTED).all(axis=1)) if poly.GetNumberOfCells() else np.empty(0)
        if not ends.size:
            self.hide()
            return
        cells = vtkCellArray()
        cells.SetData(2, numpy_to_vtkIdTypeArray(ends.ravel(), deep=True))
        lines = pv.PolyData()
        lines.SetPoints(poly.GetPoints())
        lines.SetLines(cells)
        for actor in self._actors:
            actor.mapper.SetInputData(lines)
            actor.SetVisibility(True)

    def hide(self) -> None:
        """Outline nothing."""
        for actor in self._actors:
            actor.SetVisibility(False)


def _edges(poly: pv.PolyData, marked: np.ndarray) -> np.ndarray:
    """Ends of the edges of the marked polygons, each edge once, (k, 2) int64."""
    polys = poly.GetPolys()
    nodes = vtk_to_numpy(polys.GetConnectivityArray()).astype(np.int64)
    offsets = vtk_to_numpy(polys.GetOffsetsArray())
    following = np.empty_like(nodes)
    following[:-1] = nodes[1:]
    following[offsets[1:] - 1] = nodes[offsets[:-1]]  # a polygon's last edge comes back to its first node
    chosen = np.repeat(marked, np.diff(offsets))
    start, end = nodes[chosen], following[chosen]
    keys = np.unique(np.minimum(start, end) * poly.GetNumberOfPoints() + np.maximum(start, end))
    return np.column_stack(np.divmod(keys, poly.GetNumberOfPoints()))


def _actor(plotter: pv.BasePlotter, name: str, colour: str, width: float, before: float) -> pv.Actor:
    actor = plotter.add_mesh(
        pv.Line(),
        name=name,
        color=colour,
        line_width=width,
        lighting=False,
        reset_camera=False,
        pickable=False,
        render=False,
    )
    actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, before)
    return actor
