"""Fitting of a camera to a box."""

import numpy as np
import pytest
import pyvista as pv
from hypothesis import given
from hypothesis import strategies as st
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.fitting import fit

DIRECTIONS = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.hypot(v[0], v[1]) > 0.01)
SIZES = st.tuples(*[st.floats(0.01, 100)] * 3)


def corners_seen(direction, size, aspect, parallel):
    """Return the positions of the corners of a box in the picture after `fit`, from -1 to 1, (8, 2)."""
    low = np.array([3.0, -7.0, 11.0])
    camera = vtkCamera()
    camera.SetFocalPoint(low + np.array(size) / 2)
    camera.SetPosition(low + np.array(size) / 2 + direction)
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelProjection(parallel)
    corners = low + np.indices((2, 2, 2)).reshape(3, 8).T * size
    fit(camera, corners, aspect)
    matrix = pv.array_from_vtkmatrix(camera.GetCompositeProjectionTransformMatrix(aspect, -1, 1))
    seen = np.column_stack([corners, np.ones(8)]) @ matrix.T
    assert (seen[:, 3] > 0).all()  # none behind the camera
    return seen[:, :2] / seen[:, 3:]


@given(DIRECTIONS, SIZES, st.floats(0.2, 5), st.booleans())
def test_the_whole_box_is_visible_and_reaches_two_opposite_sides(direction, size, aspect, parallel):
    seen = corners_seen(direction, size, aspect, parallel)
    assert np.abs(seen).max() == pytest.approx(0.96, abs=1e-4)
    tight = np.isclose(np.abs(seen).max(axis=0), 0.96, atol=1e-4)
    ends = np.column_stack([seen.min(axis=0), seen.max(axis=0)])[tight]
    np.testing.assert_allclose(ends, [[-0.96, 0.96]] * len(ends), atol=1e-4)


def test_a_point_is_centred_at_the_same_distance():
    camera = vtkCamera()
    far = camera.GetDistance()
    fit(camera, np.array([[1.0, 2.0, 3.0]] * 3), 1.5)
    assert camera.GetFocalPoint() == (1.0, 2.0, 3.0)
    assert camera.GetDistance() == pytest.approx(far)
