"""One step of all nodes: how far each may go, and what is done where a direction does not descend."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.kernels import step_limits
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.descent import LARGEST_COORDINATE, descend, is_perfect, shorten_to_range
from hexmend.optimise.search_direction import SearchDirection, TruncatedNewton, steepest_descent
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)


def problem(seed, amplitude=0.2):
    mesh = scrambled(grid(4), amplitude, seed)
    energy = MeshEnergy(mesh)
    return mesh, energy, energy.to_edge_units(mesh.points)


def own_edges(mesh, x):
    """The mean length of the edges at each node."""
    rings = mesh.topology.rings
    return np.array([np.linalg.norm(x[rings[node]] - x[node], axis=1).mean() for node in range(mesh.n_nodes)])


@given(seeds, st.sampled_from([0.1, 0.5]))
def test_no_node_goes_further_than_it_may_and_others_go_on(seed, reach):
    mesh, energy, x = problem(seed)
    taken = {}
    for most in (reach, np.inf):
        throws = [0, 5]

        def find(value, gradient, hessian, throws=throws):
            p = -0.02 * gradient / np.linalg.norm(gradient, axis=1).max()
            p[throws] *= 1e4  # two nodes are thrown far off
            return SearchDirection(p)

        taken[most] = descend(energy, x, 0.0, find, LineSearch(), most)
    moved = np.linalg.norm(taken[reach].x - x, axis=1)
    assert (moved <= reach * own_edges(mesh, x) * (1 + 1e-9)).all()
    assert np.abs(taken[reach].direction.vector).max() <= reach * own_edges(mesh, x).max() * (1 + 1e-9)
    assert taken[reach].backtracks <= taken[np.inf].backtracks


@settings(max_examples=5)
@given(seeds, st.sampled_from([0.02, 0.3]))
def test_steps_are_shortened_to_a_share_of_the_mean_edge_at_their_node(seed, reach):
    mesh, energy, x = problem(seed)
    steps = np.random.default_rng(seed).normal(scale=0.1, size=(energy.nodes.size, 3))
    found = steps.copy()
    step_limits.shorten(found, x, mesh.topology.hex_mesh, energy.nodes, reach)
    most = reach * own_edges(mesh, x)[energy.nodes]
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), np.minimum(np.linalg.norm(steps, axis=1), most))


@pytest.mark.parametrize("factor", [0.0, -1.0])
@pytest.mark.parametrize("reach", [0.5, np.inf])
def test_a_direction_that_does_not_descend_gives_way_to_steepest_descent(factor, reach):
    _, energy, x = problem(3)
    taken = descend(energy, x, 0.0, lambda value, g, hessian: SearchDirection(-factor * g), LineSearch(), reach)
    steepest = descend(energy, x, 0.0, steepest_descent, LineSearch(), reach)
    assert taken.slope == pytest.approx(steepest.slope, rel=1e-9) or reach < np.inf
    assert taken.slope < 0
    assert taken.alpha > 0
    assert energy.value(taken.x, 0.0) < taken.value


@pytest.mark.parametrize("delta", [0.0, 0.1])
def test_only_what_rounding_leaves_is_perfect(delta):
    energy = MeshEnergy(grid(3))
    assert is_perfect(energy, 0.0, delta)
    assert is_perfect(energy, 1e-31, delta)
    assert not is_perfect(energy, 1e-6, delta)
    assert not is_perfect(energy, 0.9, delta)


@pytest.mark.parametrize("longest", [1e200, -1e200, -1e104])
@pytest.mark.parametrize("unit", [1.0, 1e3])
def test_a_step_out_of_the_range_of_numbers_is_shortened_and_keeps_its_direction(longest, unit):
    step = np.array([[longest, 0.5 * longest, 0.0], [0.0, -0.25 * longest, 1.0]])
    shortened = step.copy()
    shorten_to_range(shortened, unit)
    assert np.abs(shortened).max() == pytest.approx(LARGEST_COORDINATE / unit)
    np.testing.assert_allclose(shortened / shortened[0, 0], step / longest, rtol=1e-12)
    within = np.array([[-0.99, 0.5, 0.0]]) * LARGEST_COORDINATE / unit
    again = within.copy()
    shorten_to_range(again, unit)
    np.testing.assert_array_equal(again, within)


class Ascending(TruncatedNewton):
    """Goes up, and down where it is damped: asked twice."""

    asked = 0

    def __call__(self, value, gradient, hessian):
        return SearchDirection(1e-3 * gradient, 7)

    def damped(self, gradient, hessian):
        self.asked += 1
        return SearchDirection((-1e-3 if self.asked > 1 else 1e-3) * gradient, 3, 0.002)


@pytest.mark.parametrize("floors", [False, True])
def test_a_direction_that_does_not_descend_is_damped_with_floors_too(floors):
    mesh, energy, x = problem(1)
    if floors:
        least = np.full(mesh.n_hexes, 1e-3)
        energy = energy.with_barrier(FloorBarrier(least, least, np.zeros(mesh.n_hexes, np.uint8), 0.1, 0.1, 1e-3))
    find = Ascending()
    taken = descend(energy, x, 0.0, find, LineSearch())
    assert find.asked == 2
    assert (taken.direction.shift, taken.direction.solver_iterations) == (0.002, 7 + 3 + 3)
    assert energy.value(taken.x) < taken.value
