"""The camera's way from one pose to another."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of

VECTORS = st.tuples(*[st.floats(-10, 10)] * 3)


@st.composite
def poses(draw):
    """Poses that look somewhere, with something up that is not there."""
    focal, way, up = draw(VECTORS), draw(VECTORS), draw(VECTORS)
    across = np.linalg.norm(np.cross(way, up))
    if np.linalg.norm(way) < 0.1 or across < 0.1 * np.linalg.norm(way):
        way, up = (1.0, 2.0, 3.0), (0.0, 0.0, 1.0)
    up = np.cross(way, np.cross(up, way))  # at a right angle, as a camera has it after a drag
    up = tuple(float(c) for c in up / np.linalg.norm(up))
    position = tuple(float(c) for c in np.add(focal, way))
    return CameraPose(position, focal, up, False, draw(st.floats(0.1, 10)), "z")


def camera_in(pose):
    camera = vtkCamera()
    apply_pose(camera, pose)
    return camera


@given(poses(), poses())
def test_a_flight_begins_where_the_camera_is_and_ends_in_the_very_pose(start, goal):
    camera = camera_in(start)
    flight = Flight(camera, goal)
    flight.at(0.0)
    np.testing.assert_allclose(camera.GetPosition(), start.position, atol=1e-6)
    np.testing.assert_allclose(camera.GetViewUp(), start.up, atol=1e-6)
    flight.at(1.0)
    assert pose_of(camera).looks_like(goal)


@given(poses(), poses(), st.floats(0.05, 0.95))
def test_on_its_way_it_is_between_both_and_stays_a_camera(start, goal, share):
    camera = camera_in(start)
    Flight(camera, goal).at(share)
    far = camera.GetDistance()
    low, high = sorted([start.distance, goal.distance])
    assert low * (1 - 1e-6) <= far <= high * (1 + 1e-6)
    assert abs(np.dot(camera.GetViewUp(), camera.GetDirectionOfProjection())) < 1e-6
    low, high = np.sort([start.focal, goal.focal], axis=0)
    assert (low - 1e-6 <= camera.GetFocalPoint()).all()
    assert (camera.GetFocalPoint() <= high + 1e-6).all()


def test_it_turns_the_shorter_way_round():
    start = CameraPose((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), False, 1.0, "z")
    goal = CameraPose((0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), False, 1.0, "z")
    camera = camera_in(start)
    Flight(camera, goal).at(0.5)
    np.testing.assert_allclose(camera.GetPosition(), (0.5**0.5, -(0.5**0.5), 0), atol=1e-9)


def test_the_projection_is_that_of_the_goal():
    start = CameraPose((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), False, 1.0, "z")
    camera = camera_in(start)
    Flight(camera, CameraPose(start.position, start.focal, start.up, True, 4.0, "z")).at(0.5)
    assert camera.GetParallelProjection()
    assert camera.GetParallelScale() == pytest.approx(2.0)
