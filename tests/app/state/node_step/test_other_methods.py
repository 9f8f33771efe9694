"""One node's step by methods that are not local descents: global ones, averages, GETMe."""

import itertools

import numpy as np
import pytest

from hexmend import METHODS, GETMe, Laplacian, SmartLaplacian, measure
from hexmend.energy import MeshEnergy
from hexmend.gallery import make
from hexmend_app.state.node_step import StepStatus, explain
from tests.app.state.node_step.node_steps import GLOBAL, OTHERS, after, patch_energy
from tests.core.grids import grid, scrambled

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
