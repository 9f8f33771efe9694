"""Polygons with a colour each, as VTK draws them."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend_app.scene.layers.edges import EDGE, tone_edges
from hexmend_app.scene.palette import rgb

_COLOURS = "colours"
_HEX = "hex"

#: The colours of the points of polygons that are drawn finely.
SHADED = "shaded"


class Surface:
    """One actor for polygons that come, move and change colour.

    Parameters
    ----------
    renderer : vtkRenderer
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, renderer: vtkRenderer, pen: float = 1.0):
        self.poly = pv.PolyData()
        self._edges, self._without_edges = True, False
        self.actor = vtkActor()
        self.actor.PickableOff()
        how = self.actor.GetProperty()
        how.SetEdgeColor(rgb(EDGE))
        how.SetEdgeOpacity(0.5)
        how.SetLineWidth(pen)
        how.SetAmbient(0.58)
        how.SetDiffuse(0.47)
        how.SetInterpolationToPhong()  # of polygons that have normals
        tone_edges(self.actor)
        renderer.AddActor(self.actor)
        self._plain, self._fine = vtkPolyDataMapper(), vtkPolyDataMapper()
        self._plain.SetScalarModeToUseCellFieldData()
        self._fine.SetScalarModeToUsePointFieldData()
        for mapper, colours in ((self._plain, _COLOURS), (self._fine, SHADED)):
            mapper.SelectColorArray(colours)
            mapper.SetColorModeToDirectScalars()
            mapper.ScalarVisibilityOn()
        self._fit_edges()
        self.actor.SetVisibility(False)

    def replace(self, poly: pv.PolyData) -> None:
        """Draw other polygons; they carry their colours (see `coloured`)."""
        self.poly = poly
        self._plain.SetInputData(poly)
        self.actor.SetMapper(self._plain)
        self.actor.SetVisibility(poly.GetNumberOfCells() > 0)

    def stand_in(self, poly: pv.PolyData | None) -> None:
        """Draw other polygons for a while, without edges; None draws the own again."""
        self._plain.SetInputData(self.poly if poly is None else poly)
        self.actor.SetMapper(self._plain)
        self._without_edges = poly is not None
        self._fit_edges()

    def refine(self, poly: pv.PolyData) -> None:
        """Take the polygons as `hexmend_app.scene.layers.fine.fine` has made them."""
        self._fine.SetInputData(poly)

    def show_fine(self) -> None:
        """Draw them so, until there are others."""
        self.actor.SetMapper(self._fine)
        self._without_edges = False
        self._fit_edges()

    @property
    def corners(self) -> int:
        """How many corners the polygons have together."""
        return self.poly.GetPolys().GetNumberOfConnectivityIds()

    def hide(self) -> None:
        """Draw nothing."""
        self.actor.SetVisibility(False)

    @property
    def shown(self) -> bool:
        """Whether anything is drawn."""
        return bool(self.actor.GetVisibility())

    def cull(self, on: bool) -> None:
        """Leave out polygons that are seen from behind, or not."""
        self.actor.GetProperty().SetBackfaceCulling(on)

    def show_edges(self, on: bool) -> None:
        """Draw the polygons' edges or not."""
        self._edges = on
        self._fit_edges()

    def _fit_edges(self) -> None:
        self.actor.GetProperty().SetEdgeVisibility(self._edges and not self._without_edges)


def quads(points: np.ndarray, faces: np.ndarray, colours: np.ndarray, hexes: np.ndarray) -> pv.PolyData:
    """Quads with a colour and a hex each: points (u, 3), faces (k, 4), colours (k, 3) uint8, hexes (k,) int32."""
    return coloured(pv.PolyData.from_regular_faces(points, faces), colours, hexes)


def coloured(data: pv.DataSet, colours: np.ndarray, hexes: np.ndarray) -> pv.DataSet:
    """Give cells their colours, (k, 3) uint8, and say which hexes they show, (k,) int32."""
    if len(colours):  # VTK takes no empty array
        data.cell_data[_COLOURS] = colours
        data.cell_data[_HEX] = hexes.astype(np.int32, copy=False)
    return data


def recoloured(poly: pv.PolyData, colours: np.ndarray) -> pv.PolyData:
    """The same polygons in other colours, (k, 3) uint8; nothing else is copied."""
    answer = poly.copy(deep=False)
    answer.cell_data[_COLOURS] = colours
    return answer


def hex_of(data: pv.DataSet, cell: int) -> int:
    """The hex that a cell shows."""
    return int(data.cell_data[_HEX][cell])


def hexes_of(poly: pv.PolyData) -> np.ndarray:
    """The hexes that polygons show, (k,) int32."""
    return np.asarray(poly.cell_data[_HEX])


def colours_of(poly: pv.PolyData) -> np.ndarray:
    """The colours that polygons carry, (k, 3) uint8."""
    return np.asarray(poly.cell_data[_COLOURS])


def set_points(data: pv.DataSet, points: np.ndarray) -> None:
    """Write the points in place and tell VTK, which does not notice by itself."""
    if not len(points):
        return
    data.points[:] = points
    data.GetPoints().Modified()
    data.Modified()


def set_colours(data: pv.DataSet, colours: np.ndarray) -> None:
    """Write the cells' colours in place and tell VTK."""
    if not len(colours):
        return
    data.cell_data[_COLOURS][:] = colours
    data.GetCellData().GetArray(_COLOURS).Modified()
    data.Modified()
