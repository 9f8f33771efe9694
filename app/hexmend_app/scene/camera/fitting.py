"""Where a camera has to stand so that a box just fills the picture, and how large a length is in the picture."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

#: Share of the picture's half that stays free at the tightest side.
_MARGIN = 0.04


def fit(camera: pv.Camera, bounds: tuple[float, float, float, float, float, float], aspect: float) -> None:
    """Bring a camera that looks at the centre of a box so near that the box just fills the picture.

    VTK itself makes room for the sphere around the box, which leaves a third of the picture empty. In perspective the
    near half of the box looks larger: the camera then steps aside a little, so that the margins are equal.

    Parameters
    ----------
    camera : pyvista.Camera
        Its direction is kept; its place, focal point and parallel scale are set.
    bounds : tuple of 6 floats
        x low, x high, y low, y high, z low, z high.
    aspect : float
        Width of the picture by its height.
    """
    low, high = np.reshape(bounds, (3, 2)).T
    corners = (np.indices((2, 2, 2)).reshape(3, 8).T - 0.5) * (high - low)  # seen from the centre
    ahead = np.array(camera.GetDirectionOfProjection())
    right = np.cross(ahead, camera.GetViewUp())
    right /= np.linalg.norm(right)
    upwards = np.cross(right, ahead)
    depth = corners @ ahead
    tangent = np.tan(np.radians(camera.GetViewAngle()) / 2) * (1 - _MARGIN)
    distance, scale, aside = 0.0, 0.0, np.zeros(3)
    for axis, stretch in ((right, aspect), (upwards, 1.0)):
        # A corner at u along the axis is in the picture when |u - shift| <= (distance + depth) slope.
        u, slope = corners @ axis, tangent * stretch
        most, least = (u - depth * slope).max(), (u + depth * slope).min()
        distance = max(distance, (most - least) / (2 * slope))
        scale = max(scale, np.abs(u).max() / stretch / (1 - _MARGIN))
        aside += (most + least) / 2 * axis
    if not scale > 0:
        return  # a box that is a point, or a line seen from its end
    if camera.GetParallelProjection():
        aside = np.zeros(3)
    target = (low + high) / 2 + aside
    camera.SetFocalPoint(target)
    camera.SetPosition(target - distance * ahead)
    camera.SetParallelScale(scale)


def pixels(renderer: vtkRenderer, length: float, at: np.ndarray) -> float:
    """How many pixels a length is in the picture.

    Parameters
    ----------
    renderer : vtkRenderer
    length : float
        Across the direction of the view, in the mesh's unit.
    at : (3,) float64
        Where it is.
    """
    camera = renderer.GetActiveCamera()
    half = camera.GetParallelScale()
    if not camera.GetParallelProjection():
        away = (at - np.array(camera.GetPosition())) @ camera.GetDirectionOfProjection()
        half = max(away, length) * np.tan(np.radians(camera.GetViewAngle()) / 2)
    return float(length / half * renderer.GetSize()[1] / 2) if half > 0 else 0.0
