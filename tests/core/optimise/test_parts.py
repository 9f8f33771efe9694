"""The parts that methods are put together from, each on its own.

Minimum residuals against a direct solver, and when they end.

Optimisers end at cubes, however high p is: what is small is not taken for nothing.

Sweeps over nodes with a linear motion: each independent node lowers the energy of the hexes at it and its copies.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.iteration import Outcome
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.element_target import Target
from hexmend.optimise import descent
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from hexmend.optimise.descent import is_perfect
from hexmend.optimise.linear_solvers import ConjugateGradients, Minres
from hexmend.optimise.minres import minres
from hexmend.optimise.search_direction import (
    ModifiedNewton,
    Newton,
    TruncatedNewton,
    TruncatedNewtonConfig,
    extreme_eigenvalues,
    steepest_descent,
)
from hexmend.run import smooth
from hexmend.smoothers import METHODS
from tests.core.grids import grid, scrambled
from tests.core.linear_motions import CASES, scrambled_within

seeds = st.integers(0, 2**32 - 1)


def test_the_line_search_takes_the_first_step_that_descends_enough():
    search = LineSearch(initial_step=1.0, backtrack_factor=0.5, c1=0.1, max_backtracks=10)
    tried = []

    def along(alpha):
        tried.append(alpha)
        return np.inf if alpha > 0.3 else (alpha - 0.2) ** 2

    assert search(along, 0.04, -0.4) == (0.25, 2)
    assert tried == [1.0, 0.5, 0.25]
    assert search(lambda alpha: 1.0, 0.04, -0.4) == (0.0, 10)
    assert search(lambda alpha: np.nan, 0.04, -0.4)[0] == 0.0


def test_the_line_search_ends_where_descent_is_less_than_rounding():
    search = LineSearch(backtrack_factor=0.5, c1=0.1, max_backtracks=100)
    assert search(lambda alpha: 1.0, 1.0, -1e-16) == (0.0, 0)
    alpha, cuts = search(lambda alpha: 1.0, 1.0, -1e-12)
    assert alpha == 0
    assert 10 < cuts < 12


@pytest.fixture(scope="module")
def problem():
    mesh = scrambled(grid(5), 0.15, 3)
    energy = MeshEnergy(mesh)
    x = energy.to_edge_units(mesh.points)
    return energy, x, energy.value(x), energy.gradient(x), energy.hessian(x)


@pytest.mark.parametrize("solver", [Minres(1e-10), ConjugateGradients(1e-10, precision=np.float64)])
def test_solvers_solve_where_the_matrix_is_positive_definite(problem, solver):
    *_, gradient, hessian = problem
    hessian = hessian.shifted(0.5)
    matrix = hessian.assembled(np.float64).matrix().toarray()
    assert np.linalg.eigvalsh(matrix)[0] > 0
    solution, count = solver(hessian, gradient.ravel())
    assert 1 < count < 200
    np.testing.assert_allclose(solution, np.linalg.solve(matrix, gradient.ravel()), atol=1e-7)


def test_extreme_eigenvalues_are_good_to_a_thousandth(problem):
    *_, hessian = problem
    for shift in (0.0, -2.0):
        values = np.linalg.eigvalsh(hessian.shifted(shift).assembled(np.float64).matrix().toarray())
        least, greatest = extreme_eigenvalues(hessian.shifted(shift))
        assert (least, greatest) == pytest.approx((values[0], values[-1]), abs=2e-3 * (values[-1] - values[0]))


def test_directions_are_those_of_appendix_a(problem):
    *_, value, gradient, hessian = problem
    np.testing.assert_allclose(steepest_descent(value, gradient, hessian).vector, -gradient / (2 * np.sqrt(value)))
    newton = Newton(Minres(1e-12))(value, gradient, hessian).vector
    np.testing.assert_allclose(hessian @ newton.ravel(), -gradient.ravel(), atol=1e-8)
    indefinite = hessian.shifted(-1.0)
    found = ModifiedNewton(Minres(1e-12))(value, gradient, indefinite)
    shift = found.shift - indefinite.shift
    values = np.linalg.eigvalsh(indefinite.assembled(np.float64).matrix().toarray())
    assert shift == pytest.approx(0.001 * values[-1] - values[0], rel=1e-2)
    assert np.vdot(found.vector, gradient) < 0


def test_a_truncated_newton_step_is_as_good_as_the_model_deserves():
    mesh = make("five-side", size=300, scramble=0.1)
    energy, find = MeshEnergy(mesh), TruncatedNewton()
    x, residuals, norms = energy.to_edge_units(mesh.points), [], []
    for _ in range(7):
        gradient, hessian = energy.gradient(x), energy.hessian(x)
        found = find(energy.value(x), gradient, hessian)
        assert np.vdot(found.vector, gradient) < 0
        norms.append(np.linalg.norm(gradient))
        residuals.append(np.linalg.norm(hessian @ found.vector.ravel() + gradient.ravel()) / norms[-1])
        x = energy.moved(x, found.vector)
    assert max(residuals) < 0.5  # the tolerance is in the norm of the preconditioner
    assert min(residuals) < 0.01 < residuals[0]
    assert norms[-1] < 1e-7 * norms[0]


def test_a_hessian_that_is_not_positive_definite_is_damped_until_it_is(problem):
    *_, value, gradient, hessian = problem
    find, indefinite = TruncatedNewton(TruncatedNewtonConfig(max_damping_increases=16)), hessian.shifted(-1.0)
    found = find(value, gradient, indefinite)
    assert found.shift >= 0.05
    assert np.vdot(found.vector, gradient) < 0
    again = find(value, gradient, indefinite)
    assert again.shift == found.shift  # remembered: no attempt is lost
    find(value, gradient, hessian.shifted(5.0))
    assert find(value, gradient, hessian.shifted(5.0)).shift < found.shift  # and given up step by step


def test_a_spoilt_hex_holds_back_its_own_nodes_alone():
    mesh = grid(6)
    energy = MeshEnergy(mesh)
    x, step = energy.to_edge_units(mesh.points), np.full((energy.nodes.size, 3), 0.01)
    thrown = int(energy.nodes.size // 2)
    step[thrown] = [1.8, 0.1, 0.2]
    before = step.copy()
    assert energy.value(energy.moved(x, step)) == np.inf
    descent.halve_harmful_steps(energy, x, 0.0, step)
    assert np.isfinite(energy.value(energy.moved(x, step)))
    kept = (step == before).all(axis=1)
    touched = np.isin(mesh.hexes, energy.nodes[thrown]).any(axis=1)
    near = np.isin(energy.nodes, mesh.hexes[touched])
    assert kept[~near].all()
    assert np.count_nonzero(~kept[near]) > 0
    assert not kept[thrown]
    np.testing.assert_allclose(step[thrown] / before[thrown], (step[thrown] / before[thrown])[0])


def indefinite(size, seed, condition):
    """A symmetric matrix of this condition with eigenvalues of both signs, and a right-hand side."""
    random = np.random.default_rng(seed)
    q, _ = np.linalg.qr(random.normal(size=(size, size)))
    return (q * (np.geomspace(1, condition, size) * random.choice([-1, 1], size))) @ q.T, random.normal(size=size)


@given(st.integers(2, 40), st.integers(0, 2**32 - 1), st.sampled_from([1e1, 1e3]))
def test_it_solves_what_has_eigenvalues_of_both_signs(size, seed, condition):
    matrix, right = indefinite(size, seed, condition)
    x, _ = minres(matrix.__matmul__, right, 1e-9, 100 * size)
    np.testing.assert_allclose(matrix @ x, right, atol=1e-7 * np.linalg.norm(right))


@given(st.integers(5, 40), st.integers(0, 2**32 - 1), st.sampled_from([1e-1, 1e-3, 1e-6]))
def test_it_ends_by_the_residual_beside_the_right_hand_side(size, seed, tolerance):
    matrix, right = indefinite(size, seed, 1e3)
    goal = tolerance * np.linalg.norm(right)

    def left(x):
        return np.linalg.norm(right - matrix @ x)

    x, count = minres(matrix.__matmul__, right, tolerance, 1000)
    assert left(x) <= 1.01 * goal
    before, _ = minres(matrix.__matmul__, right, tolerance, count - 1)
    assert count == 1 or left(before) > 0.99 * goal


def test_a_newton_direction_is_as_good_as_its_tolerance_says():
    energy = MeshEnergy(make("bridge-sharp", size=500))
    x = energy.to_edge_units(energy.mesh.points)
    hessian, right = energy.hessian(x), -energy.gradient(x).ravel()
    step, count = Minres(tolerance=1e-6, iterations=10_000)(hessian, right)
    assert count < 10_000
    assert np.linalg.norm(right - hessian @ step) == pytest.approx(0, abs=2e-6 * np.linalg.norm(right))


@pytest.mark.parametrize("sound", [0, 1, 2])
def test_the_last_iterate_is_given_where_the_matrix_leaves_the_range_of_numbers(sound):
    matrix, calls = np.diag([3.0, 2.0, 1.0, 0.5]), []

    def product(x):
        calls.append(1)
        return matrix @ x if len(calls) <= sound else np.full(4, np.inf)

    with np.errstate(all="ignore"):
        x, count = minres(product, np.ones(4), 1e-12, 10)
    assert count == sound + 1
    expected, _ = minres(matrix.__matmul__, np.ones(4), 1e-12, sound) if sound else (np.zeros(4), 0)
    np.testing.assert_array_equal(x, expected)


EXPONENTS = [1.0, 2.0, 4.0, 8.0, 16.0]


@pytest.mark.parametrize(
    ("name", "p"),
    [
        ("global-nr", 16.0),
        ("global-mnr", 8.0),
        ("local-sd", 2.0),
        ("local-nr", 4.0),
        ("local-mnr", 16.0),
        ("mend", 16.0),
    ],
)
def test_optimisers_reach_the_cubes_of_a_scrambled_grid_whatever_p(name, p):
    result = smooth(make("cube", size=64, scramble=0.4), METHODS[name](p=p), max_iterations=1000)
    assert result.outcome is Outcome.CONVERGED
    assert result.after.q_min == pytest.approx(1.0, abs=2e-5)


@pytest.mark.parametrize("offset", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("p", [*EXPONENTS, 32.0])
def test_a_mesh_of_cubes_is_perfect_and_one_a_little_away_is_not(p, offset):
    cubes, other = grid(4), scrambled(grid(4), 0.01)
    for mesh, answer in ((cubes, True), (other, False)):
        energy = MeshEnergy(mesh, ObjectiveNorm(p, offset))
        assert is_perfect(energy, energy.value(energy.to_edge_units(mesh.points)), 0.0) == answer


@pytest.mark.parametrize("p", [8.0, 16.0, 32.0])
def test_a_hessian_below_the_range_of_single_precision_keeps_its_digits(p):
    mesh = scrambled(grid(4), 0.005)
    energy = MeshEnergy(mesh, ObjectiveNorm(p))
    hessian = energy.hessian(energy.to_edge_units(mesh.points))
    v = np.random.default_rng(0).normal(size=hessian.shape[0])
    product = hessian @ v
    size = np.abs(product).max()
    np.testing.assert_allclose((hessian.assembled() @ v) / size, product / size, atol=1e-5)
    matrix = hessian.assembled()
    np.testing.assert_allclose((matrix.matrix() @ v) / size, product / size, atol=1e-5)
    solved = matrix.solve(product, 1e-6, 500, damping=0.0)
    if not solved.negative_curvature:
        np.testing.assert_allclose((hessian @ solved.x) / size, product / size, atol=1e-3)


SEARCH = LineSearch(max_backtracks=60)


def with_target(mesh, size_weight):
    lengths = np.random.default_rng(2).uniform(0.5, 1.5, (mesh.n_hexes, 3))
    return mesh.with_element_target(Target(lengths, size_weight))


@pytest.mark.parametrize(
    ("case", "size_weight", "directions"),
    [
        ("planes", None, steepest_descents),
        ("periodic", 0.0, newton_steps),
        ("layer", 1.0, steepest_descents),
        ("wedge", None, newton_steps),
        ("wedge", 1.0, steepest_descents),
    ],
)
def test_sweeps_lower_the_energy_and_move_only_what_is_chosen(case, size_weight, directions):
    mesh = scrambled_within(CASES[case](4), 0.2)
    if size_weight is not None:
        mesh = with_target(mesh, size_weight)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.5))
    motion, x = mesh.linear_motion, energy.to_edge_units(mesh.points)
    chosen = mesh.free & motion.marks(mesh.n_nodes) & (np.arange(mesh.n_nodes) % 3 > 0)
    sweeps, values, start = ConstrainedSweeps(energy, chosen), [energy.value(x, 0.01)], x.copy()
    for _ in range(4):
        sweeps(x, 0.01, directions, SEARCH)
        values.append(energy.value(x, 0.01))
    assert (np.diff(values) < 0).all()
    moved, roots = (x != start).any(axis=1), motion.roots(mesh.n_nodes)
    assert not moved[~np.isin(roots, roots[chosen])].any()
    np.testing.assert_allclose(mesh.constrained(x * energy.unit), x * energy.unit, atol=1e-13)
