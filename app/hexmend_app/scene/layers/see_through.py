"""Faces and their edges in one colour, seen through: what is not the mesh itself."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.scene.layers.flat import flat_actor

#: How strongly faces are drawn. They have one colour and no light, so that it does not matter which is drawn first.
_FACES = 0.22


class SeeThrough:
    """A surface and the lines on it, drawn by two actors.

    Parameters
    ----------
    renderer : vtkRenderer
    pen : float
        How many pixels wide a thin line is.
    edges : float
        How strongly lines are drawn, up to 1.

    Attributes
    ----------
    poly : pyvista.PolyData
        The surface; empty where there is none.
    actors : tuple of vtkActor
        That of the faces, that of the lines.
    """

    def __init__(self, renderer: vtkRenderer, pen: float, edges: float):
        self.poly = pv.PolyData()
        self.actors: tuple[vtkActor, vtkActor] = flat_actor(renderer, opacity=_FACES), flat_actor(renderer, pen, edges)

    @property
    def shown(self) -> bool:
        """Whether it is drawn."""
        return bool(self.actors[0].GetVisibility())

    @property
    def places(self) -> np.ndarray:
        """Its corners, (k, 3); none where it is not drawn."""
        return np.asarray(self.poly.points) if self.shown else np.empty((0, 3))

    def set_colour(self, colour: tuple[float, float, float]) -> None:
        """Draw both in a colour."""
        for actor in self.actors:
            actor.GetProperty().SetColor(colour)

    def take(self, poly: pv.PolyData, lines: pv.PolyData) -> None:
        """Draw another surface, with lines on its points."""
        self.poly = poly
        for actor, data in zip(self.actors, (poly, lines), strict=True):
            actor.GetMapper().SetInputData(data)

    def show(self, on: bool) -> None:
        """Draw it, if there is anything of it, or do not."""
        for actor in self.actors:
            actor.SetVisibility(bool(on and self.poly.n_cells))
