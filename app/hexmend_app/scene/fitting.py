"""Where a camera has to stand so that a box just fills the picture."""

from __future__ import annotations

import numpy as np
import pyvista as pv

#: Share of the picture's half that stays free at the tightest side.
_MARGIN = 0.04


def fit(camera: pv.Camera, bounds: tuple[float, float, float, float, float, float], aspect: float) -> None:
    """Bring a camera that looks at the centre of a box so near that the box just fills the picture.

    VTK itself makes room for the sphere around the box, which leaves a third of the picture empty.

    Parameters
    ----------
    camera : pyvista.Camera
        Its direction is kept; its distance and its parallel scale are set.
    bounds : tuple of 6 floats
        x low, x high, y low, y high, z low, z high.
    aspect : float
        Width of the picture by its height.
    """
    low, high = np.reshape(bounds, (3, 2)).T
    unit = (np.mgrid[0:2, 0:2, 0:2] - 0.5).reshape(3, 8).T
    corners = unit * (high - low)  # seen from the centre
    ahead = np.array(camera.GetDirectionOfProjection())
    right = np.cross(ahead, camera.GetViewUp())
    right /= np.linalg.norm(right)
    across = np.abs(corners @ right) / aspect
    upwards = np.abs(corners @ np.cross(right, ahead))
    half = np.maximum(across, upwards) / (1 - _MARGIN)
    if not half.max() > 0:
        return  # a box that is a point, or a line seen from its end
    camera.SetParallelScale(half.max())
    # A corner at depth w is in the picture when half <= (distance + w) tan(angle / 2).
    distance = (half / np.tan(np.radians(camera.GetViewAngle()) / 2) - corners @ ahead).max()
    camera.SetPosition(np.array(camera.GetFocalPoint()) - distance * ahead)
