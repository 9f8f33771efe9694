"""View directions and the vertical axis."""

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera import DIRECTIONS
from hexmend_app.scene.camera.directions import UPS, look_from, up_in


@pytest.mark.parametrize("up", UPS)
@pytest.mark.parametrize("name", DIRECTIONS)
def test_the_vertical_axis_is_up_in_all_views_not_along_it(name, up):
    camera = vtkCamera()
    look_from(camera, name, up)
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


@pytest.mark.parametrize("up", UPS)
def test_a_view_along_the_vertical_axis_has_another_up_vector(up):
    axis = np.array(UPS[up][0])
    assert up_in(tuple(3 * axis), up) == UPS[up][1]
    assert up_in(tuple(-axis), up) == UPS[up][1]
    assert up_in((1.0, 2.0, 3.0), up) == UPS[up][0]
