"""A camera led by steps."""

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.directions import UPS, look_from
from hexmend_app.scene.camera.steering import turn


@pytest.mark.parametrize("up", UPS)
def test_steps_to_the_right_lead_around_upright_and_come_back(up):
    camera = vtkCamera()
    look_from(camera, "iso", up)
    axis, before = np.array(UPS[up][0]), np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 15, 0, up)
        right = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
        assert abs(right @ axis) < 1e-9  # what is upright stands upright in the picture
        assert np.array(camera.GetPosition()) @ axis == pytest.approx(before @ axis)
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)


def test_to_the_right_what_is_in_front_goes_right():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    right = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
    turn(camera, 15, 0, "z")
    near = np.array([1.0, 0.0, 0.0])  # of the mesh, at the camera's side
    now = np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp())
    assert near @ now > near @ right + 0.1


def test_on_its_head_right_is_right_too():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    camera.Roll(180)
    turn(camera, 15, 0, "z")
    near = np.array([1.0, 0.0, 0.0])
    assert near @ np.cross(camera.GetDirectionOfProjection(), camera.GetViewUp()) > 0.1


def test_over_a_pole_and_all_around():
    camera = vtkCamera()
    look_from(camera, "+x", "z")
    before = np.array(camera.GetPosition())
    for _ in range(24):
        turn(camera, 0, 15, "z")
    np.testing.assert_allclose(camera.GetPosition(), before, atol=1e-9)
