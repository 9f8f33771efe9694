"""Flights of the camera between poses."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of

VECTORS = st.tuples(*[st.floats(-10, 10)] * 3)


@st.composite
def poses(draw):
    """Generate poses with an up vector that is not along the view direction."""
    focal, offset, up = draw(VECTORS), draw(VECTORS), draw(VECTORS)
    across = np.linalg.norm(np.cross(offset, up))
    if np.linalg.norm(offset) < 0.1 or across < 0.1 * np.linalg.norm(offset):
        offset, up = (1.0, 2.0, 3.0), (0.0, 0.0, 1.0)
    up = np.cross(offset, np.cross(up, offset))  # at a right angle, as a camera has it after a drag
    up = tuple(float(c) for c in up / np.linalg.norm(up))
    position = tuple(float(c) for c in np.add(focal, offset))
    return CameraPose(position, focal, up, False, draw(st.floats(0.1, 10)), "z")


def camera_in(pose):
    camera = vtkCamera()
    apply_pose(camera, pose)
    return camera


@given(poses(), poses())
def test_a_flight_starts_at_the_current_pose_and_ends_at_the_goal(start, goal):
    camera = camera_in(start)
    flight = Flight(camera, goal)
    flight.at(0.0)
    np.testing.assert_allclose(camera.GetPosition(), start.position, atol=1e-6)
    np.testing.assert_allclose(camera.GetViewUp(), start.up, atol=1e-6)
    flight.at(1.0)
    assert pose_of(camera).looks_like(goal)


def test_a_flight_takes_the_shorter_rotation():
    start = CameraPose((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), False, 1.0, "z")
    goal = CameraPose((0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), False, 1.0, "z")
    camera = camera_in(start)
    Flight(camera, goal).at(0.5)
    np.testing.assert_allclose(camera.GetPosition(), (0.5**0.5, -(0.5**0.5), 0), atol=1e-9)
