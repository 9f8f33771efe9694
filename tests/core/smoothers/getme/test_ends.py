"""When GETMe ends, with what weights it begins, and by what its steps are shortened: numbers that are known."""

import numpy as np
import pytest

from hexmend import METHODS, measure
from hexmend.smoothers.getme.sequential import HALVINGS
from hexmend.smoothers.getme.simultaneous import figures_of_merit
from tests.core.grids import grid, scrambled

GETMe, Sequential = METHODS["getme"], METHODS["getme-sequential"]


@pytest.mark.parametrize("patience", [1, 2, 5])
def test_a_grid_of_cubes_ends_after_so_many_iterations_without_a_rise(patience):
    assert len(list(GETMe(patience=patience).steps(grid(3)))) == 1 + patience


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
