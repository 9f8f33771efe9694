"""When GETMe ends, with what weights it begins, and by what its steps are shortened: numbers that are known."""

import itertools

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend.smoothers import METHODS
from hexmend.smoothers.getme.sequential import HALVINGS
from hexmend.smoothers.getme.simultaneous import figures_of_merit
from tests.core.grids import grid, scrambled

GETMe, Sequential = METHODS["getme"], METHODS["getme-sequential"]


@pytest.mark.parametrize("patience", [1, 2, 5])
def test_a_grid_of_cubes_ends_after_so_many_iterations_without_a_rise(patience):
    assert len(list(GETMe(patience=patience).steps(grid(3)))) == 1 + patience


def test_where_something_has_risen_lately_it_goes_on():
    steps = list(GETMe(patience=2).steps(scrambled(grid(3), 0.3)))
    best, idle = figures_of_merit(measure(steps[0].points, grid(3).hexes)), 0
    for step in steps[1:]:
        assert idle < 2
        now = figures_of_merit(step.quality)
        idle = 0 if (now > best + 1e-6).any() else idle + 1
        best = np.maximum(best, now)
    assert idle == 2


def test_what_is_to_rise_are_inverted_hexes_with_a_minus_and_the_least_and_mean_quality():
    figures = measure(*(getattr(scrambled(grid(3), 1.0, 2), name) for name in ("points", "hexes")))
    assert figures.n_inverted > 0
    assert figures_of_merit(figures).tolist() == [-figures.n_inverted, figures.q.min(), figures.q.mean()]


def test_weights_are_their_formulas():
    q = np.array([0.0, 0.005, 0.25, 1.0])
    np.testing.assert_allclose(GETMe().hex_weights(q), [10, 10, 2, 1])
    np.testing.assert_allclose(GETMe(weights="paper", exponent=4.0).hex_weights(q), [1, 0.995**2, 0.75**2, 1e-24])
    np.testing.assert_allclose(GETMe(weights="paper", exponent=0.0).hex_weights(q), np.ones(4))
    assert GETMe(weights="equal").hex_weights(q).tolist() == [1, 1, 1, 1]


def test_sequential_halves_its_share_after_each_sweep_without_a_rise_and_then_ends():
    steps = list(Sequential(relaxation=0.2).steps(grid(3)))[1:]
    assert [step.diagnostics["relaxation"] for step in steps] == [0.2 / 2**k for k in range(HALVINGS + 1)]
    assert all(step.intermediate for step in steps)


def test_sequential_keeps_its_share_while_the_least_quality_rises():
    mesh = scrambled(grid(3), 0.3)
    steps = list(itertools.islice(Sequential().steps(mesh), 1, 15))
    q = [measure(mesh.points, mesh.hexes).q.min(), *(step.quality.q.min() for step in steps)]
    shares = [step.diagnostics["relaxation"] for step in steps]
    for k, (now, later) in enumerate(itertools.pairwise(shares)):
        assert later == (now if q[k + 1] - q[k] > 1e-4 else now / 2)
    assert shares[0] == shares[1] == 0.1
