"""The camera of views, brought to where it sees what it is to see."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkBoundingBox
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.directions import Vector, look_from
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.flight import ELEMENT_FAR, PATCH_FAR, Flight
from hexmend_app.scene.camera.pose import Pose

if TYPE_CHECKING:
    from hexmend_app.scene.viewport import Viewport


class Eye:
    """Leads the camera that some views share.

    Attributes
    ----------
    up : str
        The axis that is up: x, y or z.

    Parameters
    ----------
    views : callable
        Gives the views that are seen.
    aspect : callable
        Gives the width of the picture by its height.
    """

    def __init__(self, views: Callable[[], Sequence[Viewport]], aspect: Callable[[], float]):
        self._views, self._aspect = views, aspect
        self.up = "z"
        self._fitted: tuple[float, ...] = ()  # where the camera stands after `fit`

    @classmethod
    def of(cls, view: Viewport) -> Eye:
        """That of one view alone."""
        return cls(lambda: [view], view.layers[0].GetTiledAspectRatio)

    @property
    def camera(self) -> vtkCamera:
        """What is looked through."""
        return self._views()[0].camera

    def fit(self) -> None:
        """Show what is shown as large as it can be, from where the camera looks; before a mesh is drawn, do nothing."""
        if self._views()[0].frame is not None:
            self._fit(self.camera)
            self._fitted = self._reach
            self.reset_depth()

    def _fit(self, camera: vtkCamera) -> None:
        fit(camera, np.concatenate([view.places for view in self._views()]), self._aspect())

    @property
    def fitted(self) -> bool:
        """Whether the camera has at most turned since all was fitted into the picture."""
        return self._fitted == self._reach

    @property
    def _reach(self) -> tuple[float, ...]:
        """What changes as the camera is shifted or zooms, but not as it turns."""
        camera = self.camera
        return *camera.GetFocalPoint(), round(camera.GetDistance(), 9), camera.GetParallelScale()

    def look_along(self, direction: str | Vector) -> None:
        """Look at what is shown from a direction: a name of `VIEWS`, or a vector."""
        look_from(self.camera, direction, self.up)
        self.fit()

    def set_up(self, axis: str) -> None:
        """Let another axis be up: x, y or z; the mesh is seen from a corner anew."""
        if axis != self.up:
            self.up = axis
            self.look_along("iso")

    def set_parallel(self, on: bool) -> None:
        """Parallel projection, or perspective; what is looked at stays as large as it is."""
        camera, fitted = self.camera, self.fitted
        tangent = np.tan(np.radians(camera.GetViewAngle()) / 2)
        if on and not camera.GetParallelProjection():
            camera.SetParallelScale(camera.GetDistance() * tangent)
        elif camera.GetParallelProjection() and not on:
            focal, ahead = np.array(camera.GetFocalPoint()), np.array(camera.GetDirectionOfProjection())
            camera.SetPosition(focal - camera.GetParallelScale() / tangent * ahead)
        camera.SetParallelProjection(on)
        if fitted:
            self.fit()
        self.reset_depth()

    def roll(self, degrees: float) -> None:
        """Turn the picture, counter-clockwise."""
        self.camera.Roll(degrees)

    def reset_depth(self) -> None:
        """Fit what is near and far enough to be drawn to where the camera is."""
        box = vtkBoundingBox()
        for view in self._views():
            box.AddBounds(view.layers[0].ComputeVisiblePropBounds())
        if box.IsValid():
            bounds = [0.0] * 6
            box.GetBounds(bounds)
            self._views()[0].layers[0].ResetCameraClippingRange(bounds)

    # Ways to elsewhere

    def flight_along(self, direction: str | Vector) -> Flight:
        """To where what is shown is seen whole from a direction."""
        camera = vtkCamera()
        camera.DeepCopy(self.camera)
        look_from(camera, direction, self.up)
        self._fit(camera)
        return Flight(self.camera, Pose.of(camera))

    def flight_to(self, hexes: np.ndarray) -> Flight:
        """To a hex, or a patch of several, in the middle of the picture: their corners, (k, 8, 3) float64."""
        corners = hexes.reshape(-1, 3)
        centre = corners.mean(axis=0)
        radius = float(np.sqrt(np.square(corners - centre).sum(axis=1).max()))
        away = ELEMENT_FAR if len(hexes) == 1 else PATCH_FAR
        return self._flight_before(centre, away * radius if radius > 0 else self.camera.GetDistance(), radius > 0)

    def flight_around(self, place: np.ndarray) -> Flight:
        """To where the camera turns about a place, (3,) float64, which is then in the middle of the picture."""
        return self._flight_before(place, self.camera.GetDistance(), False)

    def _flight_before(self, place: np.ndarray, far: float, zoom: bool) -> Flight:
        """To this far before a place, looking in the direction of now; `zoom` in parallel projection too."""
        camera, now = self.camera, Pose.of(self.camera)
        ahead = np.array(camera.GetDirectionOfProjection())
        scale = far * np.tan(np.radians(camera.GetViewAngle()) / 2) if zoom else now.scale
        position = tuple(float(c) for c in place - far * ahead)
        return Flight(camera, Pose(position, tuple(float(c) for c in place), now.up, now.parallel, float(scale)))
