"""Outline around each visible invalid hex, light with a dark rim, which marks it besides its colour."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.colour.colouring import are_invalid
from hexmend_app.scene.geometry.coloured_polygons import colours_of
from hexmend_app.scene.geometry.edge_flags import edge_flags
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth

# Colour, width in pixels, and depth offset in VTK's units: the dark rim, and the light line in front of it. The light
# line contrasts with the dark end of every colour map and with magenta, the rim with the light end. The rim is a dark
# magenta, so that hexes no larger than their outlines still look invalid.
_LINES = (("#4a062b", 3.0, -4.0), ("#ffffff", 1.5, -8.0))

#: Minimum edge length, in widths of a thin line, at which each hex is outlined instead of each region.
_MIN_EDGE = 8.0

#: Tolerance for merging corners of a cut, and of curved faces, which VTK cuts hex by hex with rounding errors of 1e-8,
#: as a fraction of the extent.
_TOLERANCE, _CURVED_TOLERANCE = 1e-9, 1e-6


class InvalidOutline:
    """Outlines the invalid hexes of a surface, or the regions that they form if hexes are small in the picture.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self._renderer, self._min_edge = renderer, _MIN_EDGE * pixel_ratio
        self._actors = [_actor(renderer, colour, pixel_ratio * width, depth) for colour, width, depth in _LINES]
        self._each, self._regions = pv.PolyData(), pv.PolyData()
        self._edge, self._centre = 0.0, np.zeros(3)  # median edge length, in the mesh's unit, and centre
        self._renderer.AddObserver("StartEvent", self._fit)
        self.hide()

    def outline(self, poly: pv.PolyData, divisions: int = 1) -> None:
        """Outline the polygons that have the colours of invalid hexes; the outlines share the points.

        The edges of faces are divided into `divisions` each.
        """
        marked = are_invalid(colours_of(poly)) if poly.GetNumberOfCells() else np.zeros(0, bool)
        if not marked.any():
            self.hide()
            return
        ends, once = outlines(poly, marked)
        self._each, self._regions = _lines(poly, ends), _lines(poly, ends[once])
        points = np.asarray(poly.points)
        self._edge = divisions * float(np.median(np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1)))
        self._centre = points[ends[:, 0]].mean(axis=0)
        for actor in self._actors:
            actor.GetMapper().SetInputData(self._each)
            actor.SetVisibility(True)

    def hide(self) -> None:
        """Hide the outlines."""
        for actor in self._actors:
            actor.SetVisibility(False)

    def _fit(self, *_: object) -> None:
        """Outline each hex if hexes are large enough in the picture, else each region."""
        if not self._actors[0].GetVisibility():
            return
        large = pixels(self._renderer, self._edge, self._centre) >= self._min_edge
        for actor in self._actors:
            actor.GetMapper().SetInputData(self._each if large else self._regions)


def outlines(poly: pv.PolyData, marked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the edges of marked polygons, (k, 2) int64, and True for edges of a single polygon, (k,) bool.

    Edges that divide a curved face are left out.

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
    following[offsets[1:] - 1] = nodes[offsets[:-1]]  # the last edge of a polygon ends at its first node
    chosen = np.repeat(marked, np.diff(offsets))
    start, end = nodes[chosen], following[chosen]
    flags = edge_flags(poly)
    if len(nodes) == poly.GetNumberOfPoints():  # polygons of a cut do not share points: merge them
        used, index = np.unique(start, return_inverse=True)
        tolerance = _TOLERANCE if flags is None else _CURVED_TOLERANCE
        merged = used[_first_at_position(np.asarray(poly.points)[used], tolerance)]
        start, end = merged[index], merged[np.searchsorted(used, end)]
    if flags is not None:
        drawn = flags[nodes[chosen]]
        start, end = start[drawn], end[drawn]
    keys = np.minimum(start, end) * poly.GetNumberOfPoints() + np.maximum(start, end)
    keys, count = np.unique(keys, return_counts=True)
    return np.column_stack(np.divmod(keys, poly.GetNumberOfPoints())), count == 1


def _first_at_position(points: np.ndarray, tolerance: float) -> np.ndarray:
    """Return the index of the first point at the position of each point, up to rounding, (n,) int."""
    step = tolerance * max(np.ptp(points, axis=0).max(), 1e-300)
    grid = np.round((points - points.min(axis=0)) / step).astype(np.int64)
    _, first, group = np.unique(grid, axis=0, return_index=True, return_inverse=True)
    return first[group.ravel()]


def _lines(poly: pv.PolyData, ends: np.ndarray) -> pv.PolyData:
    """Build lines from pairs of point numbers, (k, 2) int64; the points are shared."""
    lines = pv.PolyData()
    lines.SetPoints(poly.GetPoints())
    lines.SetLines(pv.CellArray.from_regular_cells(ends))
    return lines


def _actor(renderer: vtkRenderer, colour: str, width: float, depth: float) -> vtkActor:
    actor = flat_actor(renderer, width, colour=colour)
    offset_depth(actor.GetMapper(), lines=depth, slope=-1.0)
    return actor
