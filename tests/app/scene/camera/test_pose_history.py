"""History of camera poses."""

import dataclasses

import pytest

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.scene.camera.pose_history import PoseHistory


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
