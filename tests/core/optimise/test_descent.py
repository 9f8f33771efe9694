"""One step of all nodes: how far each may go, and what is done where a direction does not descend.

Newton's directions: how good the solution of the linear system is to be, and what damps it.
"""

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse.linalg
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.linalg import ArpackNoConvergence

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.energy.ranks import ONE_RANK
from hexmend.kernels import step_limits
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise import search_direction
from hexmend.optimise.descent import LARGEST_COORDINATE, descend, is_perfect, shorten_to_range
from hexmend.optimise.search_direction import (
    ModifiedNewton,
    SearchDirection,
    TruncatedNewton,
    TruncatedNewtonConfig,
    steepest_descent,
)
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


CONFIG = TruncatedNewtonConfig()
FIRST, SECOND, THIRD = (CONFIG.damping_factor**k * CONFIG.tightest for k in range(3))


class Matrix:
    """Records what it is asked to solve; says that the curvature is negative while the damping is below `needed`."""

    def __init__(self, needed=0.0):
        self.needed, self.asked, self.assemblies, self.has_lent_memory = needed, [], 0, False
        self.energy = SimpleNamespace(ranks=ONE_RANK)

    def assembled(self, reuse=None):
        self.assemblies, self.has_lent_memory = self.assemblies + 1, False
        return self

    def solve(self, right, tolerance, iterations, damping, deflated):
        self.deflated = deflated
        self.asked.append((right.copy(), tolerance, iterations, damping))
        return SimpleNamespace(x=right / 2, iterations=3, negative_curvature=damping < self.needed)

    def lend_memory(self):
        pass


def tolerances(lengths, unit=1.0, **options):
    find, matrix = TruncatedNewton(TruncatedNewtonConfig(**options)), Matrix()
    for length in lengths:
        find(1.0, np.array([[unit * length, 0.0, 0.0]]), matrix)
    return [tolerance for _, tolerance, _, _ in matrix.asked]


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_the_tolerance_follows_the_square_of_what_is_left_of_the_gradient_in_any_unit(unit):
    lengths = [8.0, 4.0, 0.4, 0.08]
    found = tolerances(lengths, unit, loosest=0.5, tightest=1e-4)
    assert found == pytest.approx([0.5, 0.9 / 4, 0.9 / 100, 0.9 / 25])


def test_damping_rises_until_the_curvature_is_positive_and_falls_again_twice_as_fast():
    find, matrix = TruncatedNewton(), Matrix(needed=THIRD)
    found = find(1.0, np.ones((1, 3)), matrix)
    assert [damping for *_, damping in matrix.asked] == [0.0, FIRST, SECOND, THIRD]
    assert (found.shift, found.solver_iterations) == (THIRD, 12)
    matrix.needed, matrix.asked = 0.0, []
    for _ in range(3):
        find(1.0, np.ones((1, 3)), matrix)
    assert [damping for *_, damping in matrix.asked] == [THIRD, FIRST, 0.0]


@pytest.mark.parametrize("value", [-5.0, 0.0])
def test_steepest_descent_of_a_value_without_a_root_follows_the_gradient(value):
    hessian = SimpleNamespace(energy=SimpleNamespace(norm=ObjectiveNorm(2.0), node_lengths=None))
    found = search_direction.steepest_descent(value, np.array([[1.0, -2.0, 0.5]]), hessian)
    assert found.vector.tolist() == [[-1.0, 2.0, -0.5]]


class Shifted:
    """A Hessian that records by how much it is shifted."""

    def __init__(self, shift=0.0):
        self.shift = shift

    def shifted(self, shift):
        return Shifted(shift)


@pytest.mark.parametrize(
    ("least", "greatest", "shift"),
    [(-1.0, 100.0, 1.1), (0.05, 100.0, 0.05), (0.2, 100.0, 0.0), (-1.0, 0.01, 1.00001), (0.5, 0.01, 0.0)],
)
def test_the_least_eigenvalue_is_raised_to_a_thousandth_of_the_greatest(monkeypatch, least, greatest, shift):
    monkeypatch.setattr(search_direction, "extreme_eigenvalues", lambda hessian: (least, greatest))
    found = ModifiedNewton(lambda hessian, right: (right / 2, 5))(1.0, np.array([[2.0, 4.0, 6.0]]), Shifted())
    assert found.shift == pytest.approx(shift)
    assert (found.vector.tolist(), found.solver_iterations) == ([[-1.0, -2.0, -3.0]], 5)


def test_where_eigenvalues_are_not_found_the_least_counts_as_0_and_the_greatest_is_computed(monkeypatch):
    def fails(*args, **options):
        raise ArpackNoConvergence("none", np.empty(0), np.empty((0, 0)))

    monkeypatch.setattr(scipy.sparse.linalg, "eigsh", fails)
    mesh = scrambled(grid(3), 0.2, 1)
    energy = MeshEnergy(mesh)
    hessian = energy.hessian(energy.to_edge_units(mesh.points), 0.0)
    least, greatest = search_direction.extreme_eigenvalues(hessian)
    assert least == 0.0
    matrix = np.column_stack([hessian.assembled() @ row for row in np.eye(hessian.shape[0])])
    assert greatest == pytest.approx(
        max(np.linalg.eigvalsh(matrix[at : at + 3, at : at + 3]).max() for at in range(0, len(matrix), 3))
    )
