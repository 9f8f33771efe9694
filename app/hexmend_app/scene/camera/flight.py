"""Smooth movement of a camera from one pose to another."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of

#: From how far an element is looked at, in radii of the sphere around it: near enough to see it among its neighbours.
#: Distance from a patch of hexes, of which the inside must be visible.
ELEMENT_FAR, PATCH_FAR = 9.0, 5.0


class Flight:
    """Interpolates a camera between its present pose and another: rotation, focal point and distance.

    Parameters
    ----------
    camera : vtkCamera
        Takes the pose's projection at once.
    goal : CameraPose
    """

    def __init__(self, camera: vtkCamera, goal: CameraPose):
        self._camera, self.goal = camera, goal
        start = pose_of(camera)
        self._focus = np.array(start.focal), np.array(goal.focal)
        self._far = start.distance, goal.distance
        self._scale = start.scale, goal.scale
        one, other = _quaternion(start), _quaternion(goal)
        self._turned = one, other if one @ other >= 0 else -other  # the shorter way round

    def at(self, share: float) -> None:
        """Set the camera to the pose at a share of the movement, 0 to 1, with gentle start and end."""
        if share >= 1:
            apply_pose(self._camera, self.goal)
            return
        s = share * share * (3 - 2 * share)
        focus = (1 - s) * self._focus[0] + s * self._focus[1]
        far, scale = (a ** (1 - s) * b**s if a > 0 and b > 0 else b for a, b in (self._far, self._scale))
        _, upwards, backwards = _axes(_between(*self._turned, s))
        camera = self._camera
        camera.SetFocalPoint(focus)
        camera.SetPosition(focus + far * backwards)
        camera.SetViewUp(upwards)
        camera.SetParallelProjection(self.goal.parallel)
        camera.SetParallelScale(scale)


def _quaternion(pose: CameraPose) -> np.ndarray:
    """Return the rotation of a camera in a pose as a quaternion, (4,)."""
    backwards = np.subtract(pose.position, pose.focal)
    backwards /= np.linalg.norm(backwards)
    right = np.cross(pose.up, backwards)
    right /= np.linalg.norm(right)
    answer = np.empty(4)
    vtkMath.Matrix3x3ToQuaternion(np.column_stack([right, np.cross(backwards, right), backwards]), answer)
    return answer


def _axes(quaternion: np.ndarray) -> np.ndarray:
    """Return the right, up and backward vectors of a rotated camera, (3, 3), one a row."""
    turned = np.empty((3, 3))
    vtkMath.QuaternionToMatrix3x3(quaternion, turned)
    return turned.T


def _between(one: np.ndarray, other: np.ndarray, share: float) -> np.ndarray:
    """Interpolate between unit quaternions (slerp)."""
    angle = np.arccos(min(one @ other, 1.0))
    if angle < 1e-6:
        return other
    return (np.sin((1 - share) * angle) * one + np.sin(share * angle) * other) / np.sin(angle)
