"""Fitting of a camera to points, and sizes in pixels."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

#: Free margin at the tightest side, as a fraction of half the picture.
_MARGIN = 0.04


def bounds_of(places: np.ndarray) -> tuple[float, float, float, float, float, float]:
    """Return the bounds of points, (k, 3): x low, x high, y low, y high, z low, z high."""
    low, high = places.min(axis=0), places.max(axis=0)
    return tuple(np.column_stack([low, high]).ravel().astype(float).tolist())


def fit(camera: vtkCamera, places: np.ndarray, aspect: float) -> None:
    """Move a camera so that points just fill the picture.

    VTK fits the bounding sphere of the bounding box, which leaves a third of the picture empty. In perspective, nearer
    points look larger; the camera is shifted sideways so that opposite margins are equal.

    Parameters
    ----------
    camera : vtkCamera
        Its direction is preserved; its position, focal point and parallel scale are set.
    places : (k, 3) float64
        At least one point.
    aspect : float
        Width of the picture by its height.
    """
    centre = (places.min(axis=0) + places.max(axis=0)) / 2
    forward = np.array(camera.GetDirectionOfProjection())
    right = np.cross(forward, camera.GetViewUp())
    right /= np.linalg.norm(right)
    upwards = np.cross(right, forward)
    depth, *across = ((places - centre) @ np.column_stack([forward, right, upwards])).T
    tangent = np.tan(np.radians(camera.GetViewAngle()) / 2) * (1 - _MARGIN)
    distance, scale, shift = 0.0, 0.0, np.zeros(3)
    parallel = camera.GetParallelProjection()
    for axis, u, stretch in ((right, across[0], aspect), (upwards, across[1], 1.0)):
        # A point at u along the axis is in the picture if |u - shift| <= (distance + depth) slope.
        slope = tangent * stretch
        upper, lower = (u - depth * slope).max(), (u + depth * slope).min()
        distance = max(distance, (upper - lower) / (2 * slope))
        scale = max(scale, np.ptp(u) / 2 / stretch / (1 - _MARGIN))
        shift += ((u.min() + u.max()) if parallel else (upper + lower)) / 2 * axis
    if not scale > 0:  # all points coincide in the picture
        distance, scale = camera.GetDistance(), camera.GetParallelScale()
    target = centre + shift
    camera.SetFocalPoint(target)
    camera.SetPosition(target - distance * forward)
    camera.SetParallelScale(scale)


def pixels(renderer: vtkRenderer, length: float, at: np.ndarray) -> float:
    """Return the size of a length in the picture in pixels.

    Parameters
    ----------
    renderer : vtkRenderer
    length : float
        Length perpendicular to the view direction, in the unit of the mesh.
    at : (3,) float64
        Position of the length.
    """
    camera = renderer.GetActiveCamera()
    half_height = camera.GetParallelScale()
    if not camera.GetParallelProjection():
        depth = (at - np.array(camera.GetPosition())) @ camera.GetDirectionOfProjection()
        half_height = max(depth, length) * np.tan(np.radians(camera.GetViewAngle()) / 2)
    return float(length / half_height * renderer.GetSize()[1] / 2) if half_height > 0 else 0.0
