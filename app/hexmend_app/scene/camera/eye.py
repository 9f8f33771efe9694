"""The camera of a view, brought to where it sees what it is to see."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend_app.scene.camera.directions import look_along
from hexmend_app.scene.camera.fitting import bounds_of, fit
from hexmend_app.scene.camera.flight import ELEMENT_FAR, PATCH_FAR, Flight
from hexmend_app.scene.pane import Pane


class Eye:
    """Leads a plotter's camera.

    Parameters
    ----------
    plotter : pyvista.BasePlotter or Pane
    """

    def __init__(self, plotter: pv.BasePlotter | Pane):
        self._plotter = plotter

    @property
    def camera(self) -> pv.Camera:
        """The plotter's camera."""
        return self._plotter.camera

    def look_along(self, direction: str | tuple[float, float, float]) -> None:
        """Look at the origin from a direction: a name of `VIEWS`, or a vector."""
        look_along(self.camera, direction)

    def fit(self, places: np.ndarray) -> None:
        """Show places, (k, 3) float64, as large as they can be, from where the camera looks; of none, do nothing."""
        if len(places):
            renderer, bounds = self._plotter.renderer, bounds_of(places)
            renderer.ResetCamera(bounds)
            fit(self.camera, places, renderer.GetTiledAspectRatio())
            renderer.ResetCameraClippingRange(bounds)

    def set_parallel(self, on: bool) -> None:
        """Parallel projection, or perspective."""
        self.camera.SetParallelProjection(on)

    def reset_depth(self) -> None:
        """Fit what is near and far enough to be drawn to where the camera is."""
        self._plotter.renderer.ResetCameraClippingRange()

    def flight_to(self, hexes: np.ndarray) -> Flight:
        """The camera's way to a hex, or to a patch of several: their corners, (k, 8, 3) float64."""
        corners = hexes.reshape(-1, 3)
        centre = corners.mean(axis=0)
        radius = float(np.sqrt(np.square(corners - centre).sum(axis=1).max()))
        return Flight(self.camera, centre, radius, ELEMENT_FAR if len(hexes) == 1 else PATCH_FAR)
