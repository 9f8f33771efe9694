"""Camera of views: fitting, directions and movements."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkBoundingBox
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from hexmend_app.picture.camera import CameraPose
from hexmend_app.scene.camera.directions import Vector, look_from
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.flight import HEX_DISTANCE, PATCH_DISTANCE, Flight
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of


class CameraTarget(Protocol):
    """Interface of the views of a camera controller, implemented by `hexmend_app.scene.views.viewport.Viewport`."""

    frame: Any  # None before a mesh is drawn

    @property
    def camera(self) -> vtkCamera:
        """Camera of the view."""

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """Renderers of the view, from back to front."""

    @property
    def places(self) -> np.ndarray:
        """Points that the camera is fitted to, (k, 3)."""


class CameraController:
    """Controls the camera that several views share.

    Attributes
    ----------
    up : str
        The vertical axis: x, y or z.

    Parameters
    ----------
    views : callable
        Returns the visible views.
    aspect : callable
        Returns the aspect ratio of a view, width by height.
    """

    def __init__(self, views: Callable[[], Sequence[CameraTarget]], aspect: Callable[[], float]):
        self._views, self._aspect = views, aspect
        self.up = "z"
        self._fitted: tuple[float, ...] = ()  # `_extent` after the last `fit`

    @classmethod
    def of(cls, view: CameraTarget) -> CameraController:
        """Return the controller of a single view."""
        return cls(lambda: [view], view.layers[0].GetTiledAspectRatio)

    @property
    def camera(self) -> vtkCamera:
        """Camera of all views."""
        return self._views()[0].camera

    def fit(self) -> None:
        """Fit the shown hexes into the view without rotating the camera; do nothing before a mesh is drawn."""
        if self._views()[0].frame is not None:
            self._fit(self.camera)
            self._fitted = self._extent
            self.reset_depth()

    def _fit(self, camera: vtkCamera) -> None:
        fit(camera, np.concatenate([view.places for view in self._views()]), self._aspect())

    @property
    def fitted(self) -> bool:
        """True if the camera has at most been rotated since the last fit."""
        return self._fitted == self._extent

    @property
    def _extent(self) -> tuple[float, ...]:
        """Values of the camera that panning and zooming change, but rotation does not."""
        camera = self.camera
        return *camera.GetFocalPoint(), round(camera.GetDistance(), 9), camera.GetParallelScale()

    def apply(self, pose: CameraPose) -> None:
        """Take a pose, which stays where it is even if it happens to fit the mesh into the view."""
        self.up, self._fitted = pose.axis, ()
        apply_pose(self.camera, pose)

    def look_along(self, direction: str | Vector) -> None:
        """Show the mesh from a direction: a name of `DIRECTIONS`, or a vector."""
        look_from(self.camera, direction, self.up)
        self.fit()

    def set_up(self, axis: str) -> None:
        """Set the vertical axis, x, y or z, and return to the isometric view."""
        if axis != self.up:
            self.up = axis
            self.look_along("iso")

    def set_parallel(self, on: bool) -> None:
        """Switch between parallel and perspective projection, preserving the size of objects at the focal point."""
        camera, fitted = self.camera, self.fitted
        tangent = np.tan(np.radians(camera.GetViewAngle()) / 2)
        if on and not camera.GetParallelProjection():
            camera.SetParallelScale(camera.GetDistance() * tangent)
        elif camera.GetParallelProjection() and not on:
            focal, forward = np.array(camera.GetFocalPoint()), np.array(camera.GetDirectionOfProjection())
            camera.SetPosition(focal - camera.GetParallelScale() / tangent * forward)
        camera.SetParallelProjection(on)
        if fitted:
            self.fit()
        self.reset_depth()

    def roll(self, degrees: float) -> None:
        """Roll the camera, which rotates the picture counter-clockwise."""
        self.camera.Roll(degrees)

    def reset_depth(self) -> None:
        """Fit the clipping range to the visible objects."""
        box = vtkBoundingBox()
        for view in self._views():
            box.AddBounds(view.layers[0].ComputeVisiblePropBounds())
        if box.IsValid():
            bounds = [0.0] * 6
            box.GetBounds(bounds)
            self._views()[0].layers[0].ResetCameraClippingRange(bounds)

    # Flights

    def flight_along(self, direction: str | Vector) -> Flight:
        """Return the flight to a fitted view from a direction: a name of `DIRECTIONS`, or a vector."""
        camera = vtkCamera()
        camera.DeepCopy(self.camera)
        look_from(camera, direction, self.up)
        self._fit(camera)
        return Flight(self.camera, pose_of(camera))

    def flight_to(self, hexes: np.ndarray) -> Flight:
        """Return the flight that centres hexes, given their corners, (k, 8, 3) float64."""
        corners = hexes.reshape(-1, 3)
        centre = corners.mean(axis=0)
        radius = float(np.sqrt(np.square(corners - centre).sum(axis=1).max()))
        radii = HEX_DISTANCE if len(hexes) == 1 else PATCH_DISTANCE
        return self._flight_before(centre, radii * radius if radius > 0 else self.camera.GetDistance(), radius > 0)

    def flight_around(self, place: np.ndarray) -> Flight:
        """Return the flight that makes a point, (3,) float64, the centre of the view and of rotation."""
        return self._flight_before(place, self.camera.GetDistance(), False)

    def _flight_before(self, place: np.ndarray, distance: float, zoom: bool) -> Flight:
        """Return the flight to a distance from a point without rotation; `zoom` also scales parallel views."""
        camera, pose = self.camera, pose_of(self.camera)
        forward = np.array(camera.GetDirectionOfProjection())
        scale = distance * np.tan(np.radians(camera.GetViewAngle()) / 2) if zoom else pose.scale
        position, focal = (tuple(point.tolist()) for point in (place - distance * forward, place))
        return Flight(camera, replace(pose, position=position, focal=focal, scale=float(scale)))
