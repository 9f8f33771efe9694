"""Camera movements by steps, as keys make them."""

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
        Degrees; to the right is about the axis that is up, so that the picture stays upright.
    axis : str
        The vertical axis: x, y or z.
    """
    upright = UPS[axis][0]
    over = -1.0 if np.dot(camera.GetViewUp(), upright) < 0 else 1.0  # the picture stands on its head
    focus = camera.GetFocalPoint()
    about = vtkTransform()
    about.Translate(focus)
    about.RotateWXYZ(-right * over, upright)
    about.Translate(*np.negative(focus))
    camera.ApplyTransform(about)
    camera.Elevation(-up)
    camera.OrthogonalizeViewUp()  # or the next turn over a pole goes wrong


def pan(camera: vtkCamera, right: float, up: float) -> None:
    """Pan the picture to the right and up, by shares of its height."""
    focus, place = np.array(camera.GetFocalPoint()), np.array(camera.GetPosition())
    upwards = np.array(camera.GetViewUp())
    sidewards = np.cross(camera.GetDirectionOfProjection(), upwards)
    height = 2 * camera.GetParallelScale()
    if not camera.GetParallelProjection():
        height = 2 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle()) / 2)
    shift = height * (right * sidewards / np.linalg.norm(sidewards) + up * upwards)
    camera.SetFocalPoint(focus - shift)
    camera.SetPosition(place - shift)


def zoom(camera: vtkCamera, factor: float) -> None:
    """Zoom by a factor, in either projection."""
    camera.Dolly(factor)
    camera.SetParallelScale(camera.GetParallelScale() / factor)
