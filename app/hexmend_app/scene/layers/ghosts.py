"""Ghosts: translucent hexes around isolated hexes."""

from __future__ import annotations

import numpy as np

from hexmend_app.scene.geometry.skin import Faces, Skin
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import GHOST


class Ghosts(TranslucentSurface):
    """Draws the outer faces of the rings of hexes around isolated hexes, in one pale colour."""

    colour, face_opacity, edge_opacity = GHOST, 0.14, 0.4

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        self.actors[0].GetProperty().BackfaceCullingOn()

    def draw(self, frame: Frame, ghosts: np.ndarray | None, keep: np.ndarray | None) -> None:
        """Replace the ghosts.

        Parameters
        ----------
        frame : Frame
        ghosts : (m,) bool, optional
            True for ghosts; None if there are none.
        keep : (m,) bool
            True for hexes that are shown opaque.
        """
        if ghosts is None or not ghosts.any():
            self.hide()
            return
        faces = Skin(frame.mesh).visible(ghosts | keep)
        outer = ghosts[faces.hexes]
        self.set_faces(frame, frame.mesh.points, Faces(faces.nodes, faces.quads[outer], faces.hexes[outer]))
        self.show()

    def move(self, frame: Frame) -> None:
        """Draw the same ghosts at the current positions of their nodes."""
        if self.shown:
            self.move_faces(frame.mesh.points)
