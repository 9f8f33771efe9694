"""Fitting a camera to points, and the size of lengths in the picture."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

#: Share of the picture's half that stays free at the tightest side.
_MARGIN = 0.04


def bounds_of(places: np.ndarray) -> tuple[float, float, float, float, float, float]:
    """Return x low, x high, y low, y high, z low, z high of points, (k, 3)."""
    low, high = places.min(axis=0), places.max(axis=0)
    return tuple(float(c) for pair in zip(low, high, strict=True) for c in pair)


def fit(camera: vtkCamera, places: np.ndarray, aspect: float) -> None:
    """Move a camera until points just fill the picture, none of them outside.

    VTK itself makes room for the sphere around their box, which leaves a third of the picture empty. In perspective
    what is nearer looks larger: the camera steps aside so far that the margins are equal.

    Parameters
    ----------
    camera : vtkCamera
        Its direction is kept; its place, focal point and parallel scale are set.
    places : (k, 3) float64
        At least one.
    aspect : float
        Width of the picture by its height.
    """
    centre = (places.min(axis=0) + places.max(axis=0)) / 2
    ahead = np.array(camera.GetDirectionOfProjection())
    right = np.cross(ahead, camera.GetViewUp())
    right /= np.linalg.norm(right)
    upwards = np.cross(right, ahead)
    depth, *across = ((places - centre) @ np.column_stack([ahead, right, upwards])).T
    tangent = np.tan(np.radians(camera.GetViewAngle()) / 2) * (1 - _MARGIN)
    distance, scale, aside = 0.0, 0.0, np.zeros(3)
    parallel = camera.GetParallelProjection()
    for axis, u, stretch in ((right, across[0], aspect), (upwards, across[1], 1.0)):
        # A place at u along the axis is in the picture when |u - shift| <= (distance + depth) slope.
        slope = tangent * stretch
        most, least = (u - depth * slope).max(), (u + depth * slope).min()
        distance = max(distance, (most - least) / (2 * slope))
        scale = max(scale, np.ptp(u) / 2 / stretch / (1 - _MARGIN))
        aside += ((u.min() + u.max()) if parallel else (most + least)) / 2 * axis
    if not scale > 0:  # a point, or a line seen from its end
        distance, scale = camera.GetDistance(), camera.GetParallelScale()
    target = centre + aside
    camera.SetFocalPoint(target)
    camera.SetPosition(target - distance * ahead)
    camera.SetParallelScale(scale)


def pixels(renderer: vtkRenderer, length: float, at: np.ndarray) -> float:
    """Return the size of a length in the picture, in pixels.

    Parameters
    ----------
    renderer : vtkRenderer
    length : float
        Across the direction of the view, in the mesh's unit.
    at : (3,) float64
        Position of the length.
    """
    camera = renderer.GetActiveCamera()
    half = camera.GetParallelScale()
    if not camera.GetParallelProjection():
        away = (at - np.array(camera.GetPosition())) @ camera.GetDirectionOfProjection()
        half = max(away, length) * np.tan(np.radians(camera.GetViewAngle()) / 2)
    return float(length / half * renderer.GetSize()[1] / 2) if half > 0 else 0.0
