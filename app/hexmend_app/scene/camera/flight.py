"""A camera's way from one pose to another."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.pose import Pose

#: From how far an element is looked at, in radii of the sphere around it: near enough to see it among its neighbours.
#: And a patch of elements, of which the inside is to be seen.
ELEMENT_FAR, PATCH_FAR = 9.0, 5.0


class Flight:
    """Leads a camera from where it is to a pose: it turns, shifts and comes nearer evenly.

    Parameters
    ----------
    camera : vtkCamera
        Takes the pose's projection at once.
    goal : Pose
    """

    def __init__(self, camera: vtkCamera, goal: Pose):
        self._camera, self.goal = camera, goal
        start = Pose.of(camera)
        self._focus = np.array(start.focal), np.array(goal.focal)
        self._far = start.distance, goal.distance
        self._scale = start.scale, goal.scale
        one, other = _quaternion(start), _quaternion(goal)
        self._turned = one, other if one @ other >= 0 else -other  # the shorter way round

    def at(self, share: float) -> None:
        """Put the camera where it is after this share of the way, 0 to 1: it starts and ends gently."""
        if share >= 1:
            self.goal.give(self._camera)
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


def _quaternion(pose: Pose) -> np.ndarray:
    """How a camera in a pose is turned, (4,)."""
    backwards = np.subtract(pose.position, pose.focal)
    backwards /= np.linalg.norm(backwards)
    right = np.cross(pose.up, backwards)
    right /= np.linalg.norm(right)
    answer = np.empty(4)
    vtkMath.Matrix3x3ToQuaternion(np.column_stack([right, np.cross(backwards, right), backwards]), answer)
    return answer


def _axes(quaternion: np.ndarray) -> np.ndarray:
    """What is right, up and behind to a camera that is turned so, (3, 3), one a row."""
    turned = np.empty((3, 3))
    vtkMath.QuaternionToMatrix3x3(quaternion, turned)
    return turned.T


def _between(one: np.ndarray, other: np.ndarray, share: float) -> np.ndarray:
    """The unit quaternion that is a share of the way from one to another."""
    angle = np.arccos(min(one @ other, 1.0))
    if angle < 1e-6:
        return other
    return (np.sin((1 - share) * angle) * one + np.sin(share * angle) * other) / np.sin(angle)
