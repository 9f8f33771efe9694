"""The goal time-step: the smallest explicit step rises, no hex inverts, and where it starts does not matter."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery.gallery_mesh import scramble_nodes
from hexmend.quality.corner_heights import least_heights
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers.mend.mend import Mend
from tests.core.grids import grid


def graded(n, amplitude=0.0, seed=0):
    """A block whose hexes grow along x by a factor of 1.6 each, scrambled."""
    mesh = grid(n)
    points = mesh.points.copy()
    points[:, 0] = 1.6 ** points[:, 0]
    return scramble_nodes(mesh.with_points(points), amplitude, seed)


def step_of(mesh):
    return least_heights(mesh.points, mesh.hexes).min()


@pytest.mark.parametrize("amplitude", [0.15, 0.6])
def test_the_smallest_step_rises_above_that_of_the_optimum_of_shape(amplitude):
    mesh = graded(6, amplitude, 1)
    shape, raised = (smooth(mesh, Mend(goal=goal)) for goal in ("shape", "time-step"))
    assert raised.after.inverted == 0
    assert step_of(raised.mesh) > 1.1 * step_of(shape.mesh) > step_of(mesh)
    assert "The minimum time step of the corners that can be moved is " in raised.message
    assert step_of(raised.mesh) > 0.59


def test_a_block_that_is_at_its_optimum_stays():
    mesh = graded(4)
    result = smooth(mesh, Mend(goal="time-step"))
    assert step_of(result.mesh) >= step_of(mesh)


@given(
    st.floats(0, 0.8),
    st.sampled_from([1, 4, 12, 60]),
    st.sampled_from(["fixed", "slide"]),
    st.integers(0, 2**32 - 1),
)
def test_it_does_no_harm_wherever_it_is_stopped(amplitude, iterations, boundary, seed):
    mesh = graded(3, amplitude, seed)
    method = Mend(goal="time-step", boundary=boundary)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=iterations))
    assert result.after.inverted <= result.before.inverted
    if result.after.inverted == result.before.inverted:
        assert step_of(result.mesh) >= step_of(mesh)
    if boundary == "fixed":
        np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


def test_the_size_of_the_mesh_does_not_matter():
    mesh = graded(4, 0.3, 5)
    large = mesh.with_points(1e6 * mesh.points)
    one, other = (step_of(smooth(some, Mend(goal="time-step")).mesh) for some in (mesh, large))
    assert other == pytest.approx(1e6 * one, rel=0.01)
