"""A camera's way to an element."""

from __future__ import annotations

import numpy as np
import pyvista as pv

#: From how far an element is looked at, in radii of the sphere around it: near enough to see it among its neighbours.
#: And a patch of elements, of which the inside is to be seen.
ELEMENT_FAR, PATCH_FAR = 9.0, 5.0


class Flight:
    """Leads a camera, which keeps its direction, from where it is to a sphere in the middle of the picture.

    Parameters
    ----------
    camera : pyvista.Camera
    centre : (3,) float64
    radius : float
    away : float
        From how far it is to be looked at, in radii.
    """

    def __init__(self, camera: pv.Camera, centre: np.ndarray, radius: float, away: float):
        self._camera = camera
        ahead = np.array(camera.GetDirectionOfProjection())
        focus, place = np.array(camera.GetFocalPoint()), np.array(camera.GetPosition())
        far = away * radius if radius > 0 else float(np.linalg.norm(focus - place))
        tangent = np.tan(np.radians(camera.GetViewAngle()) / 2)
        self._focus = focus, centre
        self._far = float(np.linalg.norm(focus - place)), far
        self._scale = camera.GetParallelScale(), far * tangent
        self._ahead = ahead

    def at(self, share: float) -> None:
        """Put the camera where it is after this share of the way, 0 to 1: it starts and ends gently."""
        s = share * share * (3 - 2 * share)
        focus = (1 - s) * self._focus[0] + s * self._focus[1]
        far, scale = (a ** (1 - s) * b**s if a > 0 and b > 0 else b for a, b in (self._far, self._scale))
        self._camera.SetFocalPoint(focus)
        self._camera.SetPosition(focus - far * self._ahead)
        self._camera.SetParallelScale(scale)
