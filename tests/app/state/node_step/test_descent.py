"""The direction of steepest descent of nodes at their minimum and away from it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hexmend.smoothers import METHODS
from hexmend_app.state.mesh.inspection import describe_node
from hexmend_app.state.node_step import explain
from tests.core.grids import grid

SHEAR = np.array([[1, 0.4, 0.1], [0, 1, 0.3], [0, 0, 0.6]])
MIDDLE = 62  # of the five nodes along each axis


def sheared(shift=0.0, seed=0, size=1.0):
    """Return a sheared grid, each inner node of which is at the minimum of its energy by symmetry."""
    mesh = grid(4)
    return mesh.with_points(size * mesh.points @ SHEAR @ Rotation.random(random_state=seed).as_matrix() + shift)


def moved(mesh, distance):
    points = mesh.points.copy()
    points[MIDDLE] += distance
    return mesh.with_points(points)


@given(st.integers(0, 2**31), st.sampled_from([0.0, 10.0, 1e3, 1e6]), st.sampled_from([1e-3, 1.0, 50.0]))
def test_a_node_at_its_minimum_has_no_direction_whatever_is_left_by_rounding(seed, shift, size):
    mesh = sheared(shift, seed, size)
    assert not describe_node(mesh, MIDDLE).downhill.any()
    for p in (1.0, 2.0, 4.0):
        assert not explain(mesh, METHODS["local-sd"](p=p), MIDDLE).descent.any()


@pytest.mark.parametrize("distance", [1e-11, 1e-8, 1e-3, 0.1])
def test_a_node_that_is_away_from_its_minimum_has_one_that_leads_back(distance):
    mesh = moved(sheared(), [distance, 0, 0])
    step = explain(mesh, METHODS["local-sd"](), MIDDLE)
    for direction in (describe_node(mesh, MIDDLE).downhill, step.descent):
        assert direction[0] < 0
    np.testing.assert_array_equal(step.descent, -step.gradient)


def test_a_curve_is_rounding_if_the_energy_hardly_changes_along_it():
    assert explain(sheared(), METHODS["local-nr"](), MIDDLE).curve_is_rounding
    assert explain(moved(sheared(), [1e-12, 0, 0]), METHODS["local-nr"](), MIDDLE).curve_is_rounding
    assert not explain(moved(sheared(), [1e-4, 0, 0]), METHODS["local-nr"](), MIDDLE).curve_is_rounding
    assert explain(grid(4), METHODS["local-nr"](), MIDDLE).curve_is_rounding  # there is none
