"""Smooth movement of a camera from one pose to another."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera import CameraPose
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of

#: Distance of the camera from a hex, at which its neighbours are visible too, and from a patch of hexes, in radii of
#: their bounding sphere.
HEX_DISTANCE, PATCH_DISTANCE = 9.0, 5.0


class Flight:
    """Interpolates rotation, focal point and distance of a camera between its current pose and another.

    Parameters
    ----------
    camera : vtkCamera
        Switches to the projection of the goal immediately.
    goal : CameraPose
    """

    def __init__(self, camera: vtkCamera, goal: CameraPose):
        from scipy.spatial.transform import Rotation, Slerp  # not needed before the first flight

        self._camera, self.goal = camera, goal
        start = pose_of(camera)
        self._focus = np.array(start.focal), np.array(goal.focal)
        self._distance = start.distance, goal.distance
        self._scale = start.scale, goal.scale
        self._rotation = Slerp((0, 1), Rotation.from_matrix([_axes(start), _axes(goal)]))

    def at(self, share: float) -> None:
        """Set the camera to the pose at a fraction of the flight, 0 to 1, which starts and ends smoothly."""
        if share >= 1:
            apply_pose(self._camera, self.goal)
            return
        s = share * share * (3 - 2 * share)
        focus = (1 - s) * self._focus[0] + s * self._focus[1]
        distance, scale = (a ** (1 - s) * b**s if a > 0 and b > 0 else b for a, b in (self._distance, self._scale))
        _, upwards, backwards = self._rotation(s).as_matrix().T
        camera = self._camera
        camera.SetFocalPoint(focus)
        camera.SetPosition(focus + distance * backwards)
        camera.SetViewUp(upwards)
        camera.SetParallelProjection(self.goal.parallel)
        camera.SetParallelScale(scale)


def _axes(pose: CameraPose) -> np.ndarray:
    """Return the right, up and backward vectors of a camera as the columns of (3, 3)."""
    backwards = np.subtract(pose.position, pose.focal)
    backwards /= np.linalg.norm(backwards)
    right = np.cross(pose.up, backwards)
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(backwards, right), backwards])
