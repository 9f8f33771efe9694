"""Every method keeps the linear motion of a mesh: planes, periodic pairs, both sides of a layer, copies in a wedge."""

from dataclasses import dataclass

import numpy as np
import pytest

import hexmend as hx
from hexmend import METHODS, LinearMotion, Smoother, Step, measure
from hexmend.smoothers.mend.goals import STEP_OF_LEAST
from tests.core.grids import grid
from tests.core.linear_motions import CASES, face, planes, scrambled_within, turn

FEW = 12
#: Methods that lower the energy in each step once no hex is inverted.
DESCENTS = [name for name in METHODS if METHODS[name].optimises and name not in ("general", "mend")]


def check_periodic(given, points, n):
    for axis in range(3):
        low, high = face(given, axis, 0), face(given, axis, n)
        np.testing.assert_array_equal(points[high] - points[low], given.points[high] - given.points[low])


def check_layer(given, points, n):
    front, back = face(given, 2, 0), face(given, 2, 1)
    np.testing.assert_array_equal(points[front, :2], points[back, :2])
    np.testing.assert_array_equal(points[:, 2], given.points[:, 2])


def check_planes(given, points, n):
    for axis in range(3):
        ends = np.isin(given.points[:, axis], (0, n))
        np.testing.assert_array_equal(points[ends, axis], given.points[ends, axis])


def check_wedge(given, points, n):
    layer = grid(n, n, 1)
    front, back = face(layer, 2, 0), face(layer, 2, 1)
    np.testing.assert_allclose(points[back], points[front] @ turn(5).T, atol=2e-15 * n)
    np.testing.assert_array_equal(points[back, 0], points[front, 0])
    np.testing.assert_allclose(points[front] @ turn(-2.5) @ [0, 0, 1], 0, atol=2e-15 * n)


CHECKS = {"planes": check_planes, "periodic": check_periodic, "layer": check_layer, "wedge": check_wedge}


#: Each method with one of the cases in turn.
IN_TURN = [(method, list(CASES)[number % len(CASES)]) for number, method in enumerate(METHODS)]


@pytest.mark.parametrize(("method", "case"), [*IN_TURN, *((method, "wedge") for method in METHODS)])
def test_every_step_keeps_the_constraints(method, case):
    n = 4
    given = CASES[case](n)
    mesh, moved = scrambled_within(given, 0.45, 3), False
    for iteration in hx.iterate(mesh, method, max_iterations=FEW):
        CHECKS[case](given, iteration.points, n)
        np.testing.assert_array_equal(iteration.points[mesh.fixed], mesh.points[mesh.fixed])
        marks = mesh.linear_motion.marks(mesh.n_nodes) & mesh.free
        moved = moved or (iteration.points != mesh.points)[marks].any()
    assert moved


@pytest.mark.parametrize(("method", "case"), IN_TURN)
def test_a_tangled_mesh_is_untangled_to_its_optimum(method, case):
    n = 4
    given = CASES[case](n)
    mesh = scrambled_within(given, 0.45, 3)
    result = hx.smooth(mesh, method, max_iterations=200)
    assert result.after.inverted == 0
    if case != "wedge":  # of the others the optimum is the given lattice
        assert result.after.q_min > 0.999


@pytest.mark.parametrize(("method", "case"), [pair for pair in IN_TURN if pair[0] in DESCENTS])
def test_no_step_of_an_optimiser_raises_the_objective(method, case):
    mesh = scrambled_within(CASES[case](4), 0.2, 5)
    history = hx.smooth(mesh, method, max_iterations=FEW, keep_last=True).history
    objectives = np.array([row["objective"] for row in history])
    assert (np.diff(objectives) <= 1e-12 * objectives[0]).all()
    assert objectives[-1] < 0.8 * objectives[0]


@pytest.mark.parametrize("case", ["planes", "periodic", "layer"])
def test_mend_ends_at_the_perfect_lattice(case):
    given = CASES[case](4)
    result = hx.smooth(scrambled_within(given, 1.0), "mend")
    assert result.after.inverted == 0
    assert np.abs(result.mesh.points - given.points).max() < 1e-6


@pytest.mark.parametrize("case", CASES)
def test_the_least_scaled_jacobian_is_raised_under_constraints(case):
    mesh = scrambled_within(CASES[case](4), 0.6)
    shape = hx.smooth(mesh, "mend")
    raised = hx.smooth(mesh, "mend", goal="scaled-jacobian")
    assert raised.after.scaled_jacobian_min >= (1 - STEP_OF_LEAST) * shape.after.scaled_jacobian_min
    CHECKS[case](CASES[case](4), raised.mesh.points, 4)


@pytest.mark.parametrize("method", [name for name in METHODS if "boundary" in METHODS[name]().values()])
def test_a_boundary_that_slides_moves_linearly_where_that_is_said(method):
    """The top is tied to the bottom, which moves in its plane but for its rim; the sides slide."""
    block = grid(4)
    bottom, top = face(block, 2, 0), face(block, 2, 4)
    rim = bottom[np.isin(block.points[bottom, :2], (0, 4)).any(axis=1)]
    motion = LinearMotion.tying(top, bottom).merge(LinearMotion.in_planes(bottom, [0.0, 0, 1]))
    mesh = block.with_linear_motion(motion.merge(LinearMotion.keeping(rim)))
    shift = np.random.default_rng(1).uniform(-0.3, 0.3, mesh.points.shape) * mesh.free[:, None]
    scrambled = mesh.with_points(mesh.constrained(mesh.points + shift))
    result = hx.smooth(scrambled, method, boundary="slide", max_iterations=30)
    points = result.mesh.points
    np.testing.assert_array_equal(points[top, :2], points[bottom, :2])
    np.testing.assert_array_equal(points[top, 2], 4)
    assert result.after.inverted == 0
    assert result.after.q_min > result.before.q_min
    for axis in range(2):
        sides = np.isin(block.points[:, axis], (0, 4))
        np.testing.assert_allclose(points[sides, axis], block.points[sides, axis], atol=1e-12)


def test_nodes_with_a_linear_motion_are_not_locked():
    mesh = grid(2).with_linear_motion(planes(grid(2)))
    edge = np.flatnonzero((mesh.points == [1, 0, 0]).all(axis=1))[0]
    points = mesh.points.copy()
    points[edge, 0] = -0.5
    tangled = mesh.with_points(points)
    assert measure(points, mesh.hexes).n_inverted == 1
    result = hx.smooth(tangled, "mend")
    assert (result.before.locked_inverted, result.after.inverted) == (0, 0)
    fixed = tangled.with_linear_motion(None)
    assert hx.smooth(fixed, "mend").before.locked_inverted == 1


@dataclass(frozen=True)
class Shaking(Smoother):
    """A method that knows nothing of linear constraints."""

    name = "shaking"
    title = "Shaking"
    help = "Moves nodes at random."
    source = "none"

    def steps(self, mesh):
        points, random = mesh.points, np.random.default_rng(0)
        yield Step(points)
        while True:
            points = points + random.uniform(-0.1, 0.1, points.shape) * mesh.free[:, None]
            yield Step(points)


@pytest.mark.parametrize("case", CASES)
def test_steps_of_methods_of_others_are_constrained(case):
    given = CASES[case](4)
    for iteration in hx.iterate(given, Shaking(), max_iterations=5):
        CHECKS[case](given, iteration.points, 4)
        assert iteration.quality.n_inverted == 0
        assert iteration.largest_move > 0


@pytest.mark.parametrize("method", ["laplacian", "smart-laplacian"])
def test_laplacian_smoothing_with_nodes_in_planes_ends_at_the_perfect_grid(method):
    perfect = hx.gallery.make("cube", size=216)
    at_wall = (perfect.points == 0) | (perfect.points == 1)
    moves = np.random.default_rng(1).uniform(-0.05, 0.05, perfect.points.shape)
    moves[at_wall[:, 1:].any(axis=1)] = 0
    moves[at_wall[:, 0], 0] = 0
    ends = {"ends": np.flatnonzero(perfect.points[:, 0] == 0), "others": np.flatnonzero(perfect.points[:, 0] == 1)}
    mesh = perfect.with_points(perfect.points + moves).replace(node_sets=ends)
    result = hx.smooth(mesh, method, plane=list(ends))
    assert (result.mesh.points != mesh.points).any()
    np.testing.assert_allclose(result.mesh.points, perfect.points, atol=1e-3)
