"""Region of a hex in which det J is not positive, seen through the hex and all that is in front of it."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.curved_elements import jacobian_field
from hexmend_app.scene.geometry.polygons import surface_of
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
from hexmend_app.theme.palette import FIELD, INVERTED, rgb

#: Divisions of an edge of the hex in the grid of det J.
_DIVISIONS = 24

# Opacity of the faces of the hex; colour and width in pixels of its edges, and colour and size of the dot where det J
# is least, each with its rim first; colour and width of the border of the region on the faces; share of light that does
# not depend on the direction; angle in degrees at which the region has a crease.
_OPACITY = 0.7
_EDGES = (("#11151c", 4.0), ("#ffffff", 1.5))
_DOT = (("#4a062b", 12.0), ("#ffffff", 9.5), (INVERTED, 6.5))
_BORDER, _BORDER_WIDTH = "#4a062b", 1.5
_AMBIENT, _CREASE = 0.55, 40.0


class NegativeJacobian:
    """Draws a hex pale, and in it the region with det J <= 0, in front of everything else.

    A dot is where det J is least, so that a small region is seen too.

    Attributes
    ----------
    layers : tuple of vtkRenderer
        Of the faces of the hex, and of its edges and the region in front of them.
    region : pyvista.PolyData
        Surface of the region: where det J = 0 inside the hex, and the parts of its faces with det J < 0.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.layers: tuple[vtkRenderer, vtkRenderer] = (pane.overlay(), pane.overlay())
        self.region = pv.PolyData()
        self._faces = flat_actor(self.layers[0], opacity=_OPACITY)
        front = self.layers[1]
        self._body = flat_actor(front, colour=INVERTED)
        light = self._body.GetProperty()
        light.LightingOn()
        light.SetAmbient(_AMBIENT)
        light.SetDiffuse(1 - _AMBIENT)
        self._border = flat_actor(front, _BORDER_WIDTH * pixel_ratio, colour=_BORDER)
        self._edges = [flat_actor(front, width * pixel_ratio, colour=colour) for colour, width in _EDGES]
        self._dot = [flat_actor(front, colour=colour) for colour, _ in _DOT]
        for (_, size), actor in zip(_DOT, self._dot, strict=True):
            actor.GetProperty().SetPointSize(size * pixel_ratio)
            actor.GetProperty().RenderPointsAsSpheresOn()
            offset_depth(actor.GetMapper(), points=-1e6)
        for depth, actor in enumerate((self._border, *self._edges), start=1):
            offset_depth(actor.GetMapper(), lines=-8.0 * depth)
        self.set_dark(False)
        self.hide()

    @property
    def shown(self) -> bool:
        """True while the region is drawn."""
        return bool(self.layers[0].GetDraw())

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._faces.GetProperty().SetColor(rgb(FIELD.of(dark)))

    def show(self, nodes: np.ndarray) -> None:
        """Draw the region of a hex with these nodes, (8, 3) or (27, 3) as `jacobian_field` takes them."""
        positions, determinants = jacobian_field(nodes, _DIVISIONS)
        grid = _grid(positions, determinants)
        surface = surface_of(grid)
        self.region = grid.contour([0.0]).append_polydata(surface.clip_scalar(value=0.0))
        if self.region.n_cells:
            self.region = self.region.compute_normals(cell_normals=False, split_vertices=True, feature_angle=_CREASE)
        edges, least = _edges_of(positions), positions.reshape(-1, 3)[determinants.argmin()]
        for actor, data in (
            (self._body, self.region),
            (self._border, surface.contour([0.0])),
            *((actor, edges) for actor in self._edges),
            *((actor, pv.PolyData(least[None])) for actor in self._dot),
            (self._faces, surface),
        ):
            actor.GetMapper().SetInputData(data)
            actor.VisibilityOn()
        for layer in self.layers:
            layer.DrawOn()

    def hide(self) -> None:
        """Draw nothing."""
        for layer in self.layers:
            layer.DrawOff()


def _grid(positions: np.ndarray, determinants: np.ndarray) -> pv.StructuredGrid:
    """Return the grid of a field as `jacobian_field` returns it, with det J as scalars of its points."""
    grid = pv.StructuredGrid(*np.moveaxis(positions, -1, 0))
    grid.point_data.active_scalars_name = None
    grid.point_data["det J"] = determinants.ravel(order="F")
    grid.set_active_scalars("det J")
    return grid


def _edges_of(positions: np.ndarray) -> pv.PolyData:
    """Return the twelve edges of a grid of positions, (n, n, n, 3)."""
    along = [np.moveaxis(positions, axis, 0)[:, ::_DIVISIONS, ::_DIVISIONS] for axis in range(3)]  # (n, 2, 2, 3)
    edges = np.concatenate([one.reshape(len(positions), 4, 3).swapaxes(0, 1) for one in along])
    count, length = edges.shape[:2]
    places = np.arange(count * length).reshape(count, length)
    return pv.PolyData(edges.reshape(-1, 3), lines=pv.CellArray.from_regular_cells(places))
