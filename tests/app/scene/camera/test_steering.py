"""Stepwise camera movements."""

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.directions import UPS, look_from
from hexmend_app.scene.camera.steering import turn


@pytest.mark.parametrize("up", UPS)
def test_steps_to_the_right_keep_the_picture_upright_and_complete_a_turn(up):
    camera = vtkCamera()
    look_from(camera, "iso", up)
    axis, before = np.array(UPS[up][0]), np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 15, 0, up)
        right = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
        assert abs(right @ axis) < 1e-9  # what is upright stands upright in the picture
        assert np.array(camera.GetPosition()) @ axis == pytest.approx(before @ axis)
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)


def test_a_step_to_the_right_moves_the_front_to_the_right():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    right = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
    turn(camera, 15, 0, "z")
    near = np.array([1.0, 0.0, 0.0])  # of the mesh, at the camera's side
    now = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
    assert near @ now > near @ right + 0.1


def test_right_is_right_in_an_upside_down_picture_too():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    camera.Roll(180)
    turn(camera, 15, 0, "z")
    near = np.array([1.0, 0.0, 0.0])
    assert near @ np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp()) > 0.1


def test_steps_upwards_pass_the_poles_and_complete_a_turn():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    before = np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 0, 15, "z")
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)
