"""What is told of one node's step against what the methods do."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hexmend import METHODS, MeshError, measure
from hexmend.gallery import make
from hexmend_app.state.mesh.inspection import describe_node
from hexmend_app.state.node_step import StepStatus, Sweep, explain
from tests.app.state.node_step.node_steps import LOCAL, after, patch_energy, swept
from tests.core.grids import displaced, grid, scrambled

# Local methods


@given(
    st.sampled_from(LOCAL),
    st.integers(0, 2**32 - 1),
    st.sampled_from([0.1, 0.4, 0.9]),
    st.sampled_from([1.0, 2.0, 3.5]),
    st.sampled_from([0.001, 0.01, 0.2]),
)
def test_it_is_what_a_sweep_does_to_this_node(name, seed, amplitude, p, delta):
    mesh = scrambled(grid(3), amplitude, seed)
    mesh = mesh.with_points(2.5 * mesh.points)
    smoother = METHODS[name](p=p, delta=delta)
    node = int(np.flatnonzero(mesh.free)[seed % 8])
    step = explain(mesh, smoother, node)
    expected = swept(mesh, smoother, node)[node]
    np.testing.assert_array_equal(step.after, expected)
    assert (step.delta > 0) == (measure(mesh.points, mesh.hexes).n_inverted > 0)
    assert step.energy == pytest.approx(patch_energy(mesh, step, step.before), rel=1e-9)
    assert step.energy_after == pytest.approx(patch_energy(mesh, step, step.after), rel=1e-9)


@given(st.sampled_from(LOCAL), st.integers(0, 2**32 - 1), st.sampled_from([0.2, 0.9]))
def test_the_line_search_is_algorithm_a_5(name, seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    smoother = METHODS[name](initial_step=2.0, backtrack_factor=0.5)
    step = explain(mesh, smoother, int(np.flatnonzero(mesh.free)[seed % 8]))
    assert step.status is StepStatus.MOVED
    np.testing.assert_array_equal([t.alpha for t in step.trials], 2.0 * 0.5 ** np.arange(len(step.trials)))
    assert [t.energy < t.bound for t in step.trials] == [False] * step.backtracks + [True]
    assert step.alpha == step.trials[-1].alpha
    np.testing.assert_allclose(step.after, step.before + step.alpha * step.direction, atol=1e-13)
    for trial in step.trials:
        assert trial.bound == pytest.approx(step.energy + smoother.c1 * trial.alpha * step.slope)
        there = patch_energy(mesh, step, step.before + trial.alpha * step.direction)
        assert trial.energy == pytest.approx(there, rel=1e-8) or (trial.energy == there == np.inf)
    slope = (np.interp(1e-6, *step.curve.T) - step.energy) / 1e-6  # the curve's first chord
    assert slope < 0
    assert step.slope == pytest.approx(step.gradient @ step.direction / step.unit)
    assert step.curve[0] == pytest.approx([0, step.energy])
    assert step.curve[-1, 0] > step.alpha


def test_newton_solves_with_the_hessian_that_is_told_and_the_modified_one_with_its_shift():
    fell_back, shifted = 0, 0
    for seed in range(40):
        mesh = scrambled(grid(3), 0.6, seed)
        node = int(np.flatnonzero(mesh.free)[seed % 8])
        plain, modified = (explain(mesh, METHODS[name](), node) for name in ("local-nr", "local-mnr"))
        np.testing.assert_array_equal(plain.eigenvalues, np.linalg.eigvalsh(plain.hessian))
        solution = np.linalg.solve(plain.hessian, -plain.gradient)
        assert plain.fallback == (not plain.gradient @ solution < 0)
        if plain.fallback:
            fell_back += 1
            np.testing.assert_allclose(np.cross(plain.direction, plain.gradient), 0, atol=1e-9)
        else:
            np.testing.assert_allclose(plain.direction / plain.unit, solution, rtol=1e-6)
        raised = modified.hessian + modified.shift * np.eye(3)
        least, _, greatest = modified.eigenvalues
        assert (modified.shift > 0) == (least < 0.001 * greatest)
        shifted += modified.shift > 0
        np.testing.assert_allclose(
            raised @ modified.direction / modified.unit, -modified.gradient, rtol=1e-5, atol=1e-7
        )
        assert plain.shift == 0
    assert fell_back
    assert shifted


def test_a_node_that_cannot_move_says_why():
    mesh = grid(2)
    assert explain(mesh, METHODS["local-sd"](), 13).status is StepStatus.STATIONARY
    mesh = scrambled(grid(3), 0.9, 3)
    node = next(
        int(i)
        for i in np.flatnonzero(mesh.free)
        if measure(mesh.points, mesh.hexes[mesh.topology.node_corners[i] // 8]).n_inverted
    )
    step = explain(mesh, METHODS["local-sd"](delta=0), node)
    assert step.status is StepStatus.INFINITE
    assert np.isnan(step.eigenvalues).all()
    np.testing.assert_array_equal(step.after, step.before)
    step = explain(mesh, METHODS["local-sd"](initial_step=1e3, max_backtracks=1), node)
    assert step.status is StepStatus.NO_DESCENT
    assert (len(step.trials), step.alpha, step.move) == (2, 0, 0)


def test_only_a_free_node_that_exists_has_a_step():
    mesh = grid(2)
    with pytest.raises(MeshError, match="node 0 is fixed"):
        explain(mesh, METHODS["local-sd"](), 0)
    with pytest.raises(MeshError, match="from 0 to 26"):
        explain(mesh, METHODS["local-sd"](), 27)


# A sweep


@pytest.mark.parametrize("name", LOCAL)
@pytest.mark.parametrize("shape", ["cube", "five-side"])
def test_node_by_node_a_sweep_ends_where_the_kernels_does(name, shape):
    mesh = make(shape, size=216, scramble=0.6, seed=2)
    smoother = METHODS[name](delta_policy="adaptive")
    sweep = Sweep(mesh, smoother)
    assert sweep.delta > 0
    expected = after(mesh, smoother)
    seen = []
    for number, step in enumerate(sweep, start=1):
        assert sweep.done == number
        assert sweep.position(step.node) == number - 1
        np.testing.assert_array_equal(sweep.points[step.node], step.after)
        seen.append(step.node)
    assert sweep.finished
    assert sorted(seen) == np.flatnonzero(mesh.free).tolist()
    np.testing.assert_allclose(sweep.points, expected, rtol=0, atol=1e-13)


@pytest.mark.parametrize("done", [0, 1, 20, 63, 64])
def test_the_rest_of_a_sweep_can_be_left_to_the_kernel(done):
    mesh = make("cube", size=125, scramble=0.7, seed=1)
    smoother = METHODS["local-mnr"]()
    sweep = Sweep(mesh, smoother)
    for _ in range(done):
        next(sweep)
    before = sweep.points
    step = sweep.finish()
    assert sweep.finished
    assert (step and step.node) == (sweep.nodes[-1] if done < 64 else None)
    np.testing.assert_allclose(sweep.points, after(mesh, smoother), rtol=0, atol=1e-13)
    np.testing.assert_array_equal(sweep.points[sweep.nodes[:done]], before[sweep.nodes[:done]])
    with pytest.raises(StopIteration):
        next(sweep)


def test_looking_at_a_node_moves_none():
    sweep = Sweep(scrambled(grid(4), 0.4), METHODS["local-sd"]())
    next(sweep)
    points = sweep.points
    step = sweep.preview(int(sweep.nodes[1]))
    np.testing.assert_array_equal(sweep.points, points)
    np.testing.assert_array_equal(next(sweep).after, step.after)


def test_the_example_of_the_docs_runs(capsys):
    text = (Path(__file__).resolve().parents[4] / "docs" / "methods" / "node-step.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(program, "node-step.md", "exec"), {})
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("Moved. ['1.00', '0.70', '0.49', '0.34', '0.24']")  # four cuts, as the text says
    assert "[-" in second


# The direction of steepest descent of nodes at their minimum and away from it.


SHEAR = np.array([[1, 0.4, 0.1], [0, 1, 0.3], [0, 0, 0.6]])
MIDDLE = 62  # of the five nodes along each axis


def sheared(shift=0.0, seed=0, size=1.0):
    """Return a sheared grid, each inner node of which is at the minimum of its energy by symmetry."""
    mesh = grid(4)
    return mesh.with_points(size * mesh.points @ SHEAR @ Rotation.random(random_state=seed).as_matrix() + shift)


def moved(mesh, distance):
    return displaced(mesh, MIDDLE, distance)


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
