"""View directions and the vertical axis."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.canvas.camera_view import move_of
from hexmend_app.picture.camera import DIRECTIONS, CameraPose
from hexmend_app.scene.camera.directions import UPS, look_from
from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.pose_history import PoseHistory
from hexmend_app.scene.camera.steering import turn
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of


def looking(name, up):
    camera = vtkCamera()
    look_from(camera, name, up)
    return camera


@pytest.mark.parametrize("up", UPS)
@pytest.mark.parametrize("name", DIRECTIONS)
def test_the_vertical_axis_is_up_in_all_views_not_along_it(name, up):
    camera = looking(name, up)
    ahead, upwards = np.array(camera.GetDirectionOfProjection()), np.array(camera.GetViewUp())
    axis = np.array(UPS[up][0])
    assert np.linalg.norm(np.cross(ahead, upwards)) > 0.5  # VTK would have to turn the camera
    if name[1:] == up:
        assert abs(ahead @ axis) == pytest.approx(1)
    else:
        np.testing.assert_array_equal(upwards, axis)
    if name == "iso":
        assert np.abs(ahead).min() > 0.3  # three sides are seen
        assert ahead @ axis < 0  # from above
    else:
        np.testing.assert_allclose(ahead, np.eye(3)["xyz".index(name[1])] * (-1 if name[0] == "+" else 1))


# Stepwise camera movements.


@pytest.mark.parametrize("up", UPS)
def test_steps_to_the_right_keep_the_picture_upright_and_complete_a_turn(up):
    camera = looking("iso", up)
    axis, before = np.array(UPS[up][0]), np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 15, 0, up)
        right = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
        assert abs(right @ axis) < 1e-9  # what is upright stands upright in the picture
        assert np.array(camera.GetPosition()) @ axis == pytest.approx(before @ axis)
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)


@pytest.mark.parametrize("roll", [0, 180], ids=["upright", "upside down"])
def test_a_step_to_the_right_moves_the_front_to_the_right(roll):
    camera = looking("+x", "z")
    camera.Roll(roll)
    turn(camera, 15, 0, "z")
    near = np.array([1.0, 0.0, 0.0])  # of the mesh, at the camera's side: in the middle of the picture before the step
    assert near @ np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp()) > 0.1


def test_steps_upwards_pass_the_poles_and_complete_a_turn():
    camera = looking("+x", "z")
    before = np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 0, 15, "z")
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)


# Keys that move the camera.


PLAIN, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)


def pressed(key, held=PLAIN):
    return QKeyEvent(QEvent.Type.KeyPress, key, held)


@pytest.mark.parametrize("up", UPS)
def test_arrows_rotate_about_the_vertical_axis_and_pan_with_shift(up):
    camera = looking("iso", up)
    axis, before = np.array(UPS[up][0]), np.array(camera.GetPosition())
    move_of(pressed(Qt.Key.Key_Right), up)(camera)
    assert not np.allclose(camera.GetPosition(), before)
    assert np.array(camera.GetPosition()) @ axis == pytest.approx(before @ axis)
    assert camera.GetFocalPoint() == (0, 0, 0)
    move_of(pressed(Qt.Key.Key_Right, SHIFT), up)(camera)
    assert camera.GetFocalPoint() != (0, 0, 0)


def test_plus_and_minus_zoom_and_undo_each_other():
    camera = vtkCamera()
    far = camera.GetDistance()
    move_of(pressed(Qt.Key.Key_Plus), "z")(camera)
    assert camera.GetDistance() < far
    move_of(pressed(Qt.Key.Key_Minus), "z")(camera)
    assert camera.GetDistance() == pytest.approx(far)


@pytest.mark.parametrize("event", [(Qt.Key.Key_N,), (Qt.Key.Key_Left, ALT), (Qt.Key.Key_Shift, SHIFT)])
def test_other_keys_are_not_bound(event):
    assert move_of(pressed(*event), "z") is None


# History of camera poses.


def pose(k):
    """Return the k-th of a sequence of poses."""
    return CameraPose((float(k), 0.0, 1.0), (float(k), 0.0, 0.0), (0.0, 1.0, 0.0), False, 1.0, "z")


@pytest.fixture
def three():
    poses = PoseHistory()
    for k in range(3):
        assert poses.add(pose(k))
    return poses


def test_back_ends_at_the_first_pose_and_forward_at_the_last(three):
    assert [three.back(), three.back(), three.back()] == [pose(1), pose(0), None]
    assert not three.can_go_back
    assert [three.forward(), three.forward(), three.forward()] == [pose(1), pose(2), None]
    assert not three.can_go_forward


def test_a_new_pose_drops_the_poses_ahead(three):
    three.back()
    three.back()
    assert three.add(pose(7))
    assert not three.can_go_forward
    assert [three.back(), three.back()] == [pose(0), None]


def test_the_current_pose_is_not_added_again_despite_rounding(three):
    three.back()
    nearly = dataclasses.replace(pose(1), position=(1.0 + 1e-9, 0.0, 1.0))
    assert not three.add(nearly)
    assert three.can_go_forward
    for other in ({"parallel": True}, {"scale": 1.01}, {"up": (1.0, 0.0, 0.0)}, {"position": (1.0, 0.0, 1.01)}):
        assert not dataclasses.replace(pose(1), **other).looks_like(pose(1))


def test_the_oldest_of_many_poses_are_dropped():
    poses = PoseHistory(most=4)
    for k in range(10):
        poses.add(pose(k))
    assert [poses.back() for _ in range(4)] == [pose(8), pose(7), pose(6), None]


# Flights of the camera between poses.


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
