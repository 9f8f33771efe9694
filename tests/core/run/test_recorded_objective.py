"""The objective that runs record, show and stop by is the one that the method at work minimises."""

from itertools import pairwise

import numpy as np
import pytest

from hexmend import METHODS, Outcome, StoppingCriteria, compare, iterate, smooth
from hexmend.energy import ObjectiveNorm, energies
from hexmend.gallery import make
from hexmend.quality import measure, objective
from hexmend.report.comparison import comparison_rows, record_table
from hexmend.smoothers.base_optimiser import ObjectiveSmoother

OPTIMISERS = [name for name, cls in METHODS.items() if issubclass(cls, ObjectiveSmoother)]
POWERS = [ObjectiveNorm(p, offset) for p in (1.0, 2.0, 4.0) for offset in (0.0, 1.0)]


@pytest.fixture(scope="module")
def mesh():
    return make("five-side", size=300, scramble=0.3)


def of_points(mesh, points, norm):
    """The objective as the kernels of the optimisers have it."""
    return np.power(energies(points, mesh.hexes, offset=norm.offset), norm.p).sum()


@pytest.mark.parametrize(("name", "norm"), [(name, POWERS[k % len(POWERS)]) for k, name in enumerate(OPTIMISERS)])
def test_the_recorded_objective_is_that_of_the_method_and_never_rises(mesh, name, norm):
    shape = {"goal": "shape"} if name == "mend" else {}  # other goals pass through worse objectives
    method = METHODS[name](p=norm.p, offset=norm.offset, **shape)
    run = iterate(mesh, method, StoppingCriteria(max_iterations=25))
    values = []
    for it in run:
        if it.quality.n_inverted == 0:
            assert it.objective == pytest.approx(of_points(mesh, it.points, norm), rel=1e-12)
            values.append(run.history[-1]["objective"])
    assert len(values) > 2
    assert values[-1] < values[0]
    assert all(later <= before * (1 + 1e-12) for before, later in pairwise(values))


@pytest.mark.parametrize("name", [name for name in METHODS if name not in OPTIMISERS])
def test_methods_that_minimise_nothing_record_the_default_objective(mesh, name):
    result = smooth(mesh, name, StoppingCriteria(max_iterations=3, keep_last=True))
    assert result.history[-1]["objective"] == result.after.objective


def test_mend_that_raises_p_records_the_objective_of_the_highest():
    mesh = make("five-side", size=150)
    result = smooth(mesh, METHODS["mend"](goal="shape", p=2.0, max_p=8.0))
    figures = measure(result.mesh.points, mesh.hexes)
    assert result.history[-1]["objective"] == pytest.approx(objective(figures, 8.0), rel=1e-12)
    assert result.history[-1]["objective_formula"] == "Σ η⁸"


@pytest.mark.parametrize("norm", POWERS[1::3], ids=lambda norm: norm.formula)
def test_a_run_goes_on_for_as_long_as_the_objective_of_its_method_falls(norm):
    mesh = make("five-side", size=300)
    stop = StoppingCriteria(tolerance=1.0)  # every step is short enough: only the objective keeps it going
    result = smooth(mesh, METHODS["local-sd"](p=norm.p, offset=norm.offset), stop)
    assert result.outcome is Outcome.CONVERGED
    least = norm.cube_value * mesh.n_hexes
    values = [row["objective"] - least for row in result.history]
    falls = [
        before - now > max(1e-3 * before, 1e-2 * (norm.contribution(1.0) - norm.cube_value))
        for before, now in pairwise(values)
    ]
    assert falls == [True] * (len(falls) - 1) + [False]


def test_a_table_compares_methods_by_one_objective_and_names_it(mesh):
    methods = ["laplacian", METHODS["local-sd"](offset=0.0), METHODS["mend"](p=4.0)]
    answer = compare(mesh, methods, StoppingCriteria(max_iterations=10, keep_last=True))
    record = answer.record()
    norm = ObjectiveNorm(2.0, 0.0)  # of the first that minimises something
    meshes = [mesh, *(row.mesh for row in answer.rows)]
    for row, one in zip(comparison_rows(record), meshes, strict=True):
        assert row["objective"] == objective(measure(one.points, one.hexes), *norm)
        assert row["objective_formula"] == "Σ η², offset 0"
    table = record_table(record)
    assert "objective Σ η², offset 0" in [line[0] for line in table.rows]
    heuristics = record_table(compare(mesh, ["laplacian"], StoppingCriteria(max_iterations=2)).record())
    assert "objective Σ η²" in [line[0] for line in heuristics.rows]
