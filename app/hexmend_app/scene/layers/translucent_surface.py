"""Faces and their edges in one translucent colour, for what is not the mesh itself."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor

from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import Role, rgb


class TranslucentSurface:
    """Base of layers that draw a surface and lines on it, by two actors without light.

    One colour and no light make the order of drawing irrelevant.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    poly : pyvista.PolyData
        The surface; empty if there is none.
    actors : tuple of vtkActor
        The actor of the faces and the one of the lines.
    """

    colour: Role
    face_opacity, edge_opacity = 0.22, 0.5

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.poly = pv.PolyData()
        self.actors: tuple[vtkActor, vtkActor] = (
            flat_actor(pane.renderer, opacity=self.face_opacity),
            flat_actor(pane.renderer, pixel_ratio, self.edge_opacity),
        )
        self.set_dark(False)

    @property
    def shown(self) -> bool:
        """True while it is drawn."""
        return bool(self.actors[0].GetVisibility())

    @property
    def places(self) -> np.ndarray:
        """The points of the surface, (k, 3); none while it is not drawn."""
        return np.asarray(self.poly.points) if self.shown else np.empty((0, 3))

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark theme, or for the light one."""
        for actor in self.actors:
            actor.GetProperty().SetColor(rgb(self.colour.of(dark)))

    def set_data(self, poly: pv.PolyData, lines: pv.PolyData) -> None:
        """Replace the surface and the lines on its points."""
        self.poly = poly
        for actor, data in zip(self.actors, (poly, lines), strict=True):
            actor.GetMapper().SetInputData(data)

    def set_quads(self, points: np.ndarray, quads: np.ndarray) -> None:
        """Replace the surface by quads, (k, 4) rows of points (u, 3), with lines along their edges."""
        if not len(quads):
            self.set_data(pv.PolyData(), pv.PolyData())
            return
        poly, lines = pv.PolyData.from_regular_faces(points, quads), pv.PolyData()
        lines.SetPoints(poly.GetPoints())
        lines.lines = with_lengths(edges_of(quads))
        self.set_data(poly, lines)

    def show(self) -> None:
        """Draw the surface, if it is not empty."""
        self._set_visible(bool(self.poly.n_cells))

    def hide(self) -> None:
        """Draw nothing."""
        self._set_visible(False)

    def _set_visible(self, on: bool) -> None:
        for actor in self.actors:
            actor.SetVisibility(on)


def edges_of(*faces: np.ndarray) -> np.ndarray:
    """Return the edges of polygons, each array (k, corners), once each as (e, 2)."""
    ends = [np.stack([one, np.roll(one, 1, axis=1)], axis=-1).reshape(-1, 2) for one in faces]
    return np.unique(np.sort(np.concatenate(ends), axis=1), axis=0)


def with_lengths(rows: np.ndarray) -> np.ndarray:
    """Return cells of equal length in VTK's layout: each row behind its length, flat."""
    return np.column_stack([np.full(len(rows), rows.shape[1]), rows]).ravel()
