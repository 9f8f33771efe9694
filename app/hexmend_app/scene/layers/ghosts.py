"""Ghosts: elements around what is isolated, through which it is seen."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.flat import flat_actor
from hexmend_app.scene.layers.surface import set_points
from hexmend_app.scene.palette import GHOST, rgb
from hexmend_app.scene.skin import Faces, Skin

#: How strongly they are drawn. They have one colour and no light, so that it does not matter which is drawn first.
_FACES, _EDGES = 0.14, 0.4


class Ghosts:
    """Draws the outer faces of a patch of elements, but for those in its middle, as one pale colour.

    Parameters
    ----------
    renderer : vtkRenderer
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, renderer: vtkRenderer, pen: float = 1.0):
        self._poly, self._lines = pv.PolyData(), pv.PolyData()
        self._faces: Faces | None = None
        self._actors = flat_actor(renderer, opacity=_FACES), flat_actor(renderer, pen, _EDGES)
        self._actors[0].GetProperty().BackfaceCullingOn()
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark ground, or for the light one."""
        for actor in self._actors:
            actor.GetProperty().SetColor(rgb(GHOST.of(dark)))

    @property
    def shown(self) -> bool:
        """Whether there are any."""
        return bool(self._actors[0].GetVisibility())

    def _show(self, on: bool) -> None:
        for actor in self._actors:
            actor.SetVisibility(on)

    def hide(self) -> None:
        """Draw none."""
        self._show(False)

    @property
    def places(self) -> np.ndarray:
        """Their corners, (k, 3); none where there are no ghosts."""
        return np.asarray(self._poly.points) if self.shown else np.empty((0, 3))

    def draw(self, frame: Frame, ghosts: np.ndarray | None, keep: np.ndarray | None) -> None:
        """Draw others.

        Parameters
        ----------
        frame : Frame
        ghosts : (m,) bool, optional
            None for none.
        keep : (m,) bool, optional
            Hexes that are shown as they are.
        """
        self._show(ghosts is not None and bool(ghosts.any()))
        if not self.shown:
            return
        faces = Skin(frame.mesh).visible(ghosts | keep)
        outer = ghosts[faces.hexes]
        self._faces = Faces(faces.nodes, faces.quads[outer], faces.hexes[outer])
        quads = self._faces.quads
        edges = np.unique(np.sort(np.stack([quads, np.roll(quads, 1, axis=1)], axis=-1).reshape(-1, 2), axis=1), axis=0)
        self._poly = pv.PolyData.from_regular_faces(self._faces.places(frame.mesh.points), quads)
        self._lines = pv.PolyData()
        self._lines.SetPoints(self._poly.GetPoints())
        self._lines.lines = np.column_stack([np.full(len(edges), 2), edges]).ravel()
        for actor, poly in zip(self._actors, (self._poly, self._lines), strict=True):
            actor.GetMapper().SetInputData(poly)

    def move(self, frame: Frame) -> None:
        """Draw the same where the nodes are now."""
        if self.shown:
            set_points(self._poly, self._faces.places(frame.mesh.points))
