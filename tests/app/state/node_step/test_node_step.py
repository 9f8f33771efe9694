"""What is told of one node's step against what the methods do."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hexmend import METHODS, GETMe, Laplacian, MeshError, SmartLaplacian, measure
from hexmend.energy import MeshEnergy
from hexmend.gallery import make
from hexmend_app.state.mesh.inspection import describe_node
from hexmend_app.state.node_step import StepStatus, Sweep, explain
from tests.app.state.node_step.node_steps import GLOBAL, LOCAL, OTHERS, after, patch_energy, swept
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
    smoother = METHODS[name]()
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


# One node's step by methods that are not local descents: global ones, averages, GETMe.


# Global methods


@pytest.mark.parametrize("name", GLOBAL)
@pytest.mark.parametrize("amplitude", [0.15, 0.6])
def test_a_global_step_is_the_nodes_part_of_the_methods(name, amplitude):
    mesh = scrambled(grid(4), amplitude, 3)
    mesh = mesh.with_points(0.3 * mesh.points)
    smoother = METHODS[name](p=2.0)
    step_of_all = next(itertools.islice(smoother.steps(mesh), 1, None))
    energy = MeshEnergy(mesh)
    for node in np.flatnonzero(mesh.free)[::5].tolist():
        step = explain(mesh, smoother, node)
        np.testing.assert_array_equal(step.after, step_of_all.points[node])
        assert step.is_global
        assert step.delta == step_of_all.diagnostics["delta"]
        assert (step.alpha, step.backtracks) == (
            step_of_all.diagnostics["step_length"],
            step_of_all.diagnostics["backtracks"],
        )
        assert step.shift == step_of_all.diagnostics["shift"]
        row, x = int(np.flatnonzero(energy.nodes == node)[0]), energy.to_edge_units(mesh.points)
        assert step.energy == energy.value(x, step.delta)
        assert step.energy_after == pytest.approx(
            energy.value(energy.to_edge_units(step_of_all.points), step.delta), rel=1e-12
        )
        np.testing.assert_allclose(step.gradient, energy.gradient(x, step.delta)[row], rtol=1e-8, atol=1e-9)
        block = energy.hessian(x, step.delta).assembled(np.float64).diagonal_blocks[row]
        np.testing.assert_allclose(step.hessian[np.triu_indices(3)], block, rtol=1e-7, atol=1e-8 * np.abs(block).max())
        assert step.trials[-1].energy < step.trials[-1].bound
        assert step.trials[-1].alpha == step.alpha
        assert [t.energy < t.bound for t in step.trials] == [False] * step.backtracks + [True]
        at = step.trials[-1]
        assert np.interp(at.alpha, *step.curve.T) == pytest.approx(at.energy, rel=0.1)


def test_a_global_method_without_a_finite_energy_says_so():
    mesh = scrambled(grid(4), 0.9, 3)
    step = explain(mesh, METHODS["global-sd"](delta=0), int(np.flatnonzero(mesh.free)[0]))
    assert step.status is StepStatus.INFINITE
    step = explain(grid(3), METHODS["global-nr"](), int(np.flatnonzero(grid(3).free)[0]))
    assert step.status is StepStatus.STATIONARY


# The others


@pytest.mark.parametrize("name", [name for name in OTHERS if name not in ("laplacian", "smart-laplacian")])
def test_of_any_other_method_it_is_the_next_iteration(name):
    mesh = scrambled(grid(4), 0.5, 4)
    points = after(mesh, METHODS[name]())
    for node in np.flatnonzero(mesh.free)[::4].tolist():
        step = explain(mesh, METHODS[name](), node)
        np.testing.assert_array_equal(step.after, points[node])
        assert (step.status in (StepStatus.MOVED, StepStatus.SHORTENED)) == bool((step.after != step.before).any())
        assert step.delta > 0 or not measure(mesh.points, mesh.hexes[step.hexes]).n_inverted
        assert step.energy == pytest.approx(patch_energy(mesh, step, step.before), rel=1e-9)
        assert step.energy_after == pytest.approx(patch_energy(mesh, step, step.after), rel=1e-7)
        if len(step.curve):
            energy = patch_energy(mesh, step, step.before + step.curve[40, 0] * step.direction)
            assert step.curve[40, 1] == pytest.approx(energy, rel=1e-8)


def test_laplacian_goes_to_the_mean_of_what_it_names():
    mesh = scrambled(grid(4), 0.4, 1)
    for node in np.flatnonzero(mesh.free)[::5].tolist():
        step = explain(mesh, Laplacian(), node)
        assert step.status is StepStatus.MOVED
        assert [pull.number for pull in step.pulls] == mesh.topology.rings[node].tolist()
        np.testing.assert_allclose(step.after, sum(pull.weight * pull.place for pull in step.pulls), atol=1e-13)
    assert explain(grid(2), Laplacian(), 13).status is StepStatus.AT_TARGET


def test_smart_laplacian_says_which_moves_are_taken_back():
    seen = set()
    for seed in range(20):
        mesh = make("bridge-sharp", size=500, scramble=0.35, seed=seed)
        for node in np.flatnonzero(mesh.free)[::9].tolist():
            step = explain(mesh, SmartLaplacian(guard="quality"), node)
            seen.add(step.status)
            went = explain(mesh, Laplacian(), node)
            attached = np.ascontiguousarray(mesh.hexes[step.hexes])
            points = mesh.points.copy()
            points[node] = went.after
            was, now = measure(mesh.points, attached), measure(points, attached)
            harm = (now.inverted & ~was.inverted).any() or now.q.min() < was.q.min()
            assert (step.status is StepStatus.REJECTED) == harm
            np.testing.assert_array_equal(step.after, step.before if harm else went.after)
    assert seen == {StepStatus.MOVED, StepStatus.REJECTED}


def test_getme_goes_to_the_weighted_mean_of_its_hexes_places_or_a_part_of_the_way():
    shares = set()
    for seed in range(8):
        mesh = make("bridge-sharp", size=500, scramble=0.9, seed=seed)
        for node in np.flatnonzero(mesh.free)[::11].tolist():
            step = explain(mesh, GETMe(), node)
            assert [pull.number for pull in step.pulls] == (mesh.topology.node_corners[node] // 8).tolist()
            assert sum(pull.weight for pull in step.pulls) == pytest.approx(1)
            mean = sum(pull.weight * pull.place for pull in step.pulls)
            np.testing.assert_allclose(step.before + step.direction, mean, atol=1e-12)
            np.testing.assert_allclose(step.after, step.before + step.alpha * step.direction, atol=1e-12)
            shares.add(round(step.alpha, 9))
            assert (step.status is StepStatus.SHORTENED) == (0 < round(step.alpha, 9) < 1)
    assert shares <= {0, 0.125, 0.25, 0.5, 1}
    assert {1, 0.5} < shares


def test_the_general_method_begins_with_getme():
    mesh = scrambled(grid(3), 0.4, 2)
    node = int(np.flatnonzero(mesh.free)[0])
    step = explain(mesh, METHODS["general"](), node)
    assert step.method == "getme"
    assert step.pulls
