"""Stepwise camera movements for the keyboard."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.directions import UPS


def turn(camera: vtkCamera, right: float, up: float, axis: str) -> None:
    """Rotate the camera about its focal point.

    Parameters
    ----------
    camera : vtkCamera
    right, up : float
        Angles in degrees; `right` rotates about the vertical axis, which keeps the picture upright.
    axis : str
        The vertical axis: x, y or z.
    """
    vertical = UPS[axis][0]
    sign = -1.0 if np.dot(camera.GetViewUp(), vertical) < 0 else 1.0  # negative if the picture is upside down
    focus = camera.GetFocalPoint()
    rotation = vtkTransform()
    rotation.Translate(focus)
    rotation.RotateWXYZ(-right * sign, vertical)
    rotation.Translate(*np.negative(focus))
    camera.ApplyTransform(rotation)
    camera.Elevation(-up)
    camera.OrthogonalizeViewUp()  # otherwise the next rotation over a pole fails


def pan(camera: vtkCamera, right: float, up: float) -> None:
    """Pan the picture to the right and up, by fractions of its height."""
    focus, position = np.array(camera.GetFocalPoint()), np.array(camera.GetPosition())
    upwards = np.array(camera.GetViewUp())
    sidewards = np.cross(camera.GetDirectionOfProjection(), upwards)
    height = 2 * camera.GetParallelScale()
    if not camera.GetParallelProjection():
        height = 2 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle()) / 2)
    shift = height * (right * sidewards / np.linalg.norm(sidewards) + up * upwards)
    camera.SetFocalPoint(focus - shift)
    camera.SetPosition(position - shift)


def zoom(camera: vtkCamera, factor: float) -> None:
    """Zoom in by a factor, in either projection."""
    camera.Dolly(factor)
    camera.SetParallelScale(camera.GetParallelScale() / factor)
