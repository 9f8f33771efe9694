"""Leading a camera by steps, as keys do."""

from __future__ import annotations

import numpy as np
import pyvista as pv


def turn(camera: pv.Camera, right: float, up: float) -> None:
    """Turn what is seen to the right and up, by degrees, about the point that the camera looks at."""
    camera.Azimuth(-right)
    camera.Elevation(-up)
    camera.OrthogonalizeViewUp()  # or the next turn over a pole goes wrong


def pan(camera: pv.Camera, right: float, up: float) -> None:
    """Shift what is seen to the right and up, by shares of the picture's height."""
    focus, place = np.array(camera.GetFocalPoint()), np.array(camera.GetPosition())
    upwards = np.array(camera.GetViewUp())
    sidewards = np.cross(camera.GetDirectionOfProjection(), upwards)
    height = 2 * camera.GetParallelScale()
    if not camera.GetParallelProjection():
        height = 2 * camera.GetDistance() * np.tan(np.radians(camera.GetViewAngle()) / 2)
    shift = height * (right * sidewards / np.linalg.norm(sidewards) + up * upwards)
    camera.SetFocalPoint(focus - shift)
    camera.SetPosition(place - shift)


def zoom(camera: pv.Camera, factor: float) -> None:
    """Show what is seen larger by a factor, in either projection."""
    camera.Dolly(factor)
    camera.SetParallelScale(camera.GetParallelScale() / factor)
