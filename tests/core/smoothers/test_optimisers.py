"""What every optimiser of (3.3) has: the objective's offset, the unit of delta; and what A.1 measures."""

from itertools import islice

import numpy as np
import pytest

from hexmend import METHODS, StoppingCriteria, iterate, smooth
from hexmend.energy import SQUARES, ObjectiveNorm, objective
from hexmend.gallery import make
from hexmend.kernels import local
from hexmend.kernels.line_search import LineSearch
from hexmend.smoothers.base_optimiser import Optimiser
from tests.core.grids import grid, scrambled

OPTIMISERS = sorted(name for name, cls in METHODS.items() if issubclass(cls, Optimiser))
TOWARDS = StoppingCriteria(max_iterations=300, tolerance=1e-6)


def best(mesh, name, offset):
    shape = {"goal": "shape"} if name == "mend" else {}
    return smooth(mesh, METHODS[name](offset=offset, **shape), TOWARDS).mesh


@pytest.mark.parametrize("offset", [0.0, 0.5])
def test_local_and_global_methods_go_to_the_same_optimum_whatever_the_offset(offset):
    mesh = scrambled(grid(3, 4, 5), 0.25, 2)
    places = [best(mesh, name, offset).points for name in ("mend", "global-nr", "local-nr", "local-patch")]
    for place in places[1:]:
        np.testing.assert_allclose(place, places[0], atol=1e-3 * mesh.mean_edge_length)


def test_each_offset_has_the_lower_objective_of_its_kind_and_zero_the_higher_mean():
    mesh = make("five-side", size=500)
    ones, zeros = best(mesh, "mend", 1.0), best(mesh, "mend", 0.0)

    def value(mesh, offset):
        return objective(mesh.points, mesh.hexes, norm=ObjectiveNorm(2.0, offset))

    assert value(ones, 1.0) < value(zeros, 1.0)
    assert value(zeros, 0.0) < value(ones, 0.0)
    assert smooth(zeros, "laplacian", StoppingCriteria(max_iterations=0)).after.q_mean > (
        smooth(ones, "laplacian", StoppingCriteria(max_iterations=0)).after.q_mean
    )


@pytest.mark.parametrize("name", OPTIMISERS)
def test_delta_in_another_unit_is_another_number(name):
    mesh = scrambled(grid(4), 1.2, 1)
    mesh = mesh.with_points(3.0 * mesh.points)
    other = next(parameter for parameter in METHODS[name].to_json()["parameters"] if parameter["name"] == "delta_unit")
    unit = next(choice for choice in other["choices"] if choice != "edge")
    edges = 2.0 if unit == "extent" else 1 / mesh.mean_edge_length
    runs = [
        smooth(mesh, METHODS[name](delta=delta, delta_unit=unit), StoppingCriteria(max_iterations=2, keep_last=True))
        for delta, unit in ((0.02, unit), (0.02 * edges**3, "edge"))
    ]
    np.testing.assert_allclose(runs[0].mesh.points, runs[1].mesh.points, rtol=1e-12)
    assert runs[0].history[1]["inverted"] > 0


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
@pytest.mark.parametrize("name", OPTIMISERS)
def test_a_step_that_descends_too_little_for_armijo_is_cut(name, boundary):
    mesh = scrambled(grid(4), 0.15, 4)
    trials = []
    for c1 in (1e-6, 0.5):
        # One and a half times Newton's step gains three eighths of what the slope promises.
        method = METHODS[name](c1=c1, initial_step=1.5, boundary=boundary)
        run = iterate(mesh, method, StoppingCriteria(max_iterations=1, tolerance=0))
        trials.append(
            sum(
                step.diagnostics["energy_evaluations" if "energy_evaluations" in step.diagnostics else "backtracks"]
                for step in run
            )
        )
    assert trials[0] < trials[1]


@pytest.mark.parametrize("direction", local.Direction)
@pytest.mark.parametrize("c1", [1e-4, 0.5])
def test_the_step_of_a_node_satisfies_armijos_condition(direction, c1):
    mesh = make("five-side", size=150, scramble=0.5, seed=3)
    corners, hexes, cut = mesh.topology.node_corners, mesh.hexes, 0
    first = 30.0 if direction is local.Direction.STEEPEST_DESCENT else 1.5  # far enough to gain too little
    for node in np.flatnonzero(mesh.free):
        star = corners[node]
        value = local.patch_energy(mesh.points, hexes, star, 0.0, 0.05, SQUARES).value
        settings = local.NodeStepSettings(direction, 0.05, SQUARES, LineSearch(first, c1=c1))
        step = local.recorded_step(mesh.points, hexes, star, settings)
        if step.alpha:
            steps, reached, _ = step.trials.T
            enough = reached < value + c1 * steps * step.slope
            assert steps[-1] == step.alpha
            assert enough.tolist() == [False] * (len(steps) - 1) + [True]
            cut += (reached[:-1] < value).any()  # it descended, but not enough
    assert cut or c1 < 0.1


def test_a_step_in_the_units_of_the_mesh_is_longer_by_the_square_of_its_edges():
    mesh, descent = make("five-side", size=500), METHODS["global-sd"]
    unit = mesh.mean_edge_length

    def third(method, of):
        return [step.points for step in islice(method.steps(of), 3)][2]

    in_mesh = third(descent(step_unit="mesh"), mesh)
    np.testing.assert_allclose(third(descent(initial_step=unit**-2), mesh), in_mesh, rtol=1e-12)
    assert np.abs(third(descent(), mesh) - in_mesh).max() > 1e-3 * unit
    with_edges_of_1 = mesh.with_points(mesh.points / unit)
    np.testing.assert_allclose(
        third(descent(step_unit="mesh"), with_edges_of_1), third(descent(), with_edges_of_1), rtol=1e-12
    )
