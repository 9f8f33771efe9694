"""Outline around each visible inverted hex, light with a dark rim, so that not only its colour marks it."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.colour.colouring import INVERTED
from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.scene.layers.surface import colours_of
from hexmend_app.theme.palette import rgb

# Colour, width in pixels, and how far before the surface, in VTK's units of depth: the light line before its rim. Light
# stands out from the dark end of every map and from magenta, dark from the light end; the dark is a magenta too, so
# that elements no larger than their outlines still look alike.
_LINES = (("#4a062b", 3.0, -4.0), ("#ffffff", 1.5, -8.0))

#: Length of an edge, in thin lines' widths, below which regions are outlined instead of their elements.
_LEAST = 8.0

#: Distance, as a share of the whole, up to which two corners that a cut has made are one.
_NEARLY = 1e-9


class InvertedOutline:
    """Outlines the inverted hexes of a surface, or, if they are too small for that, the regions they form.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self._renderer, self._least = renderer, _LEAST * pixel_ratio
        self._actors = [_actor(renderer, colour, pixel_ratio * width, before) for colour, width, before in _LINES]
        self._each, self._rims = pv.PolyData(), pv.PolyData()
        self._size, self._middle = 0.0, np.zeros(3)  # of an edge, in the mesh's unit, and where it is about
        self._renderer.AddObserver("StartEvent", self._fit)
        self.hide()

    def follow(self, poly: pv.PolyData) -> None:
        """Outline the polygons that have the colour of inverted hexes.

        The points are shared: as they move, the outlines move along.
        """
        marked = (colours_of(poly) == INVERTED).all(axis=1) if poly.GetNumberOfCells() else np.zeros(0, bool)
        if not marked.any():
            self.hide()
            return
        ends, once = outlines(poly, marked)
        self._each, self._rims = _lines(poly, ends), _lines(poly, ends[once])
        points = np.asarray(poly.points)
        self._size = float(np.median(np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1)))
        self._middle = points[ends[:, 0]].mean(axis=0)
        for actor in self._actors:
            actor.GetMapper().SetInputData(self._each)
            actor.SetVisibility(True)

    def hide(self) -> None:
        """Draw nothing."""
        for actor in self._actors:
            actor.SetVisibility(False)

    def _fit(self, *_: object) -> None:
        """Outline each hex if it is large enough in the picture, else regions."""
        if not self._actors[0].GetVisibility():
            return
        space = pixels(self._renderer, self._size, self._middle) >= self._least
        for actor in self._actors:
            actor.GetMapper().SetInputData(self._each if space else self._rims)


def outlines(poly: pv.PolyData, marked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return edges of marked polygons, (k, 2) int64, and True for those of a single polygon, (k,) bool.

    Parameters
    ----------
    poly : pyvista.PolyData
    marked : (c,) bool
    """
    polys = poly.GetPolys()
    nodes = vtk_to_numpy(polys.GetConnectivityArray()).astype(np.int64)
    offsets = vtk_to_numpy(polys.GetOffsetsArray())
    following = np.empty_like(nodes)
    following[:-1] = nodes[1:]
    following[offsets[1:] - 1] = nodes[offsets[:-1]]  # a polygon's last edge comes back to its first node
    chosen = np.repeat(marked, np.diff(offsets))
    start, end = nodes[chosen], following[chosen]
    if len(nodes) == poly.GetNumberOfPoints():  # each polygon has its own, as a cut leaves them
        used, places = np.unique(start, return_inverse=True)
        same = used[_first_at_place(np.asarray(poly.points)[used])]
        start, end = same[places], same[np.searchsorted(used, end)]
    keys = np.minimum(start, end) * poly.GetNumberOfPoints() + np.maximum(start, end)
    keys, count = np.unique(keys, return_counts=True)
    return np.column_stack(np.divmod(keys, poly.GetNumberOfPoints())), count == 1


def _first_at_place(points: np.ndarray) -> np.ndarray:
    """Return for each point the first one at its position, up to rounding, (n,) int."""
    grid = np.round((points - points.min(axis=0)) / (_NEARLY * max(np.ptp(points, axis=0).max(), 1e-300))).astype(
        np.int64
    )
    _, first, which = np.unique(grid, axis=0, return_index=True, return_inverse=True)
    return first[which.ravel()]


def _lines(poly: pv.PolyData, ends: np.ndarray) -> pv.PolyData:
    """Build lines between points of polygons, (k, 2) int64; the points are shared."""
    cells = vtkCellArray()
    cells.SetData(2, numpy_to_vtkIdTypeArray(np.ascontiguousarray(ends).ravel(), deep=True))
    lines = pv.PolyData()
    lines.SetPoints(poly.GetPoints())
    lines.SetLines(cells)
    return lines


def _actor(renderer: vtkRenderer, colour: str, width: float, before: float) -> vtkActor:
    actor = flat_actor(renderer, width)
    actor.GetProperty().SetColor(rgb(colour))
    mapper = actor.GetMapper()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, before)
    return actor
