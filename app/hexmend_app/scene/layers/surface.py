"""Polygons with a colour each."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend_app.scene.layers.edge_lines import EDGE, tone_edges
from hexmend_app.theme.palette import rgb

_COLOURS = "colours"
_HEX = "hex"

#: The colours of the points of polygons that are drawn finely.
SHADED = "shaded"


class Surface:
    """Actor of polygons that are replaced, moved and recoloured.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self.poly = pv.PolyData()
        self._edges, self._without_edges = True, False
        self.actor = vtkActor()
        self.actor.PickableOff()
        prop = self.actor.GetProperty()
        prop.SetEdgeColor(rgb(EDGE))
        prop.SetEdgeOpacity(0.5)
        prop.SetLineWidth(pixel_ratio)
        prop.SetAmbient(0.58)
        prop.SetDiffuse(0.47)
        prop.SetInterpolationToPhong()  # of polygons that have normals
        tone_edges(self.actor)
        renderer.AddActor(self.actor)
        self._simple, self._fine = vtkPolyDataMapper(), vtkPolyDataMapper()
        self._simple.SetScalarModeToUseCellFieldData()
        self._fine.SetScalarModeToUsePointFieldData()
        for mapper, colours in ((self._simple, _COLOURS), (self._fine, SHADED)):
            mapper.SelectColorArray(colours)
            mapper.SetColorModeToDirectScalars()
            mapper.ScalarVisibilityOn()
        self._fit_edges()
        self.actor.SetVisibility(False)

    def replace(self, poly: pv.PolyData) -> None:
        """Replace the polygons; they carry their colours (see `coloured`)."""
        self.poly = poly
        self._simple.SetInputData(poly)
        self.actor.SetMapper(self._simple)
        self.actor.SetVisibility(poly.GetNumberOfCells() > 0)

    def show_proxy(self, poly: pv.PolyData | None) -> None:
        """Draw a proxy of the polygons, without edges; None draws the polygons themselves again."""
        self._simple.SetInputData(self.poly if poly is None else poly)
        self.actor.SetMapper(self._simple)
        self._without_edges = poly is not None
        self._fit_edges()

    def refine(self, poly: pv.PolyData) -> None:
        """Set the fine polygons, which `hexmend_app.scene.geometry.shaded_surface.shaded_surface` makes."""
        self._fine.SetInputData(poly)

    def show_fine(self) -> None:
        """Draw the fine polygons until others are set."""
        self.actor.SetMapper(self._fine)
        self._without_edges = False
        self._fit_edges()

    @property
    def corners(self) -> int:
        """Total number of corners of the polygons."""
        return self.poly.GetPolys().GetNumberOfConnectivityIds()

    def hide(self) -> None:
        """Draw nothing."""
        self.actor.SetVisibility(False)

    @property
    def shown(self) -> bool:
        """True while something is drawn."""
        return bool(self.actor.GetVisibility())

    def cull(self, on: bool) -> None:
        """Cull back faces, or not."""
        self.actor.GetProperty().SetBackfaceCulling(on)

    def show_edges(self, on: bool) -> None:
        """Draw the polygons' edges or not."""
        self._edges = on
        self._fit_edges()

    def _fit_edges(self) -> None:
        self.actor.GetProperty().SetEdgeVisibility(self._edges and not self._without_edges)


def quads(points: np.ndarray, faces: np.ndarray, colours: np.ndarray, hexes: np.ndarray) -> pv.PolyData:
    """Build quads: points (u, 3), faces (k, 4), their colours (k, 3) uint8 and hexes (k,) int32."""
    return coloured(pv.PolyData.from_regular_faces(points, faces), colours, hexes)


def coloured(data: pv.DataSet, colours: np.ndarray, hexes: np.ndarray) -> pv.DataSet:
    """Set the colours of cells, (k, 3) uint8, and the hexes that they show, (k,) int32."""
    if len(colours):  # VTK takes no empty array
        data.cell_data[_COLOURS] = colours
        data.cell_data[_HEX] = hexes.astype(np.int32, copy=False)
    return data


def recoloured(poly: pv.PolyData, colours: np.ndarray) -> pv.PolyData:
    """Return the polygons in other colours, (k, 3) uint8; nothing else is copied."""
    answer = poly.copy(deep=False)
    answer.cell_data[_COLOURS] = colours
    return answer


def hex_of(data: pv.DataSet, cell: int) -> int:
    """Return the hex that a cell shows."""
    return int(data.cell_data[_HEX][cell])


def hexes_of(poly: pv.PolyData) -> np.ndarray:
    """Return the hexes that polygons show, (k,) int32."""
    return np.asarray(poly.cell_data[_HEX])


def colours_of(poly: pv.PolyData) -> np.ndarray:
    """Return the colours of polygons, (k, 3) uint8."""
    return np.asarray(poly.cell_data[_COLOURS])


def set_points(data: pv.DataSet, points: np.ndarray) -> None:
    """Write the points in place and notify VTK."""
    if not len(points):
        return
    data.points[:] = points
    data.GetPoints().Modified()
    data.Modified()


def set_colours(data: pv.DataSet, colours: np.ndarray) -> None:
    """Write the colours of cells in place and notify VTK."""
    if not len(colours):
        return
    data.cell_data[_COLOURS][:] = colours
    data.GetCellData().GetArray(_COLOURS).Modified()
    data.Modified()
