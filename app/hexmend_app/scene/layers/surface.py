"""Polygons with a colour each, as VTK draws them."""

from __future__ import annotations

import numpy as np
import pyvista as pv

_EDGE = "#1b1f2a"
_COLOURS = "colours"
_HEX = "hex"


class Surface:
    """One actor for polygons that come, move and change colour.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
    name : str
    """

    def __init__(self, plotter: pv.BasePlotter, name: str):
        self.poly = pv.PolyData()
        self._edges, self._without_edges = True, False
        self.actor = plotter.add_mesh(
            pv.Triangle(),
            name=name,
            color="white",
            show_edges=True,
            edge_color=_EDGE,
            edge_opacity=0.5,
            line_width=1,
            lighting=True,
            ambient=0.58,
            diffuse=0.47,
            specular=0,
            smooth_shading=False,
            reset_camera=False,
            pickable=False,
            render=False,
        )
        mapper = self.actor.mapper
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(_COLOURS)
        mapper.SetColorModeToDirectScalars()
        mapper.ScalarVisibilityOn()
        self.actor.SetVisibility(False)

    def replace(self, poly: pv.PolyData) -> None:
        """Draw other polygons; they carry their colours (see `coloured`)."""
        self.poly = poly
        self.actor.mapper.SetInputData(poly)
        self.actor.SetVisibility(poly.GetNumberOfCells() > 0)

    def move(self, points: np.ndarray, colours: np.ndarray) -> None:
        """Move the points and recolour the polygons that are drawn: the cheapest change.

        Parameters
        ----------
        points : (u, 3) float64
        colours : (k, 3) uint8
        """
        set_points(self.poly, points)
        set_colours(self.poly, colours)

    def recolour(self, colours: np.ndarray) -> None:
        """Recolour the polygons, (k, 3) uint8."""
        set_colours(self.poly, colours)

    def stand_in(self, poly: pv.PolyData | None) -> None:
        """Draw other polygons for a while, without edges; None draws the own again."""
        self.actor.mapper.SetInputData(self.poly if poly is None else poly)
        self._without_edges = poly is not None
        self._fit_edges()

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
