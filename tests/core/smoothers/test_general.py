"""Algorithm 5.1: its two decisions, in words."""

import numpy as np
import pytest

from hexmend import METHODS, Outcome, StoppingCriteria, measure, smooth
from hexmend.gallery import make
from hexmend.smoothers.general import edge_length_ratio
from tests.core.grids import grid, scrambled

General = METHODS["general"]


def test_sufficient_quality_ends_with_what_getme_reached():
    mesh = scrambled(grid(4), 0.3)
    result = smooth(mesh, "general")
    assert result.outcome is Outcome.SUFFICIENT
    assert result.after.q_min >= 0.9
    assert result.after.q_min < 1 - 1e-9  # no optimiser came after
    assert "sizes" not in result.message


@pytest.mark.parametrize(
    ("mesh", "getme_iterations", "said"),
    [
        (make("five-side", size=150), 50, "similar sizes (ratio 2), no inverted hexes: Global Newton-Raphson"),
        (make("five-side", size=150, taper=0.05), 50, "different sizes (ratio 3.4), no inverted hexes: Local"),
        (make("five-side", size=150, scramble=1.5, seed=1), 0, "inverted hexes: Local steepest descent"),
    ],
    ids=["similar", "different", "inverted"],
)
def test_what_it_chooses_and_why_is_in_the_message(mesh, getme_iterations, said):
    method = General(getme_iterations=getme_iterations)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=1000))
    assert "After GETMe: " in result.message
    assert said in result.message
    assert result.outcome is Outcome.CONVERGED
    assert result.after.inverted == 0
    reference = smooth(result.mesh, "local-mnr", StoppingCriteria(tolerance=1e-6)).after
    assert result.after.q_mean == pytest.approx(reference.q_mean, abs=2e-4)


def test_size_ratio_looks_past_one_hex_in_twenty():
    mesh = grid(6)
    assert edge_length_ratio(mesh.points, mesh.hexes) == pytest.approx(1)
    points = mesh.points.copy()
    points[:, 0] *= 5.0 ** np.arange(7)[points[:, 0].astype(int)]
    assert edge_length_ratio(points, mesh.hexes) > 100
    assert edge_length_ratio(np.zeros_like(points), mesh.hexes) == np.inf


def test_getme_comes_first_and_the_iterations_of_both_are_counted():
    mesh = make("five-side", size=150, scramble=0.2)
    run = smooth(mesh, General(getme_iterations=7), StoppingCriteria(max_iterations=9))
    assert run.iterations == 9
    getme = smooth(mesh, "getme", StoppingCriteria(max_iterations=7, tolerance=0))
    assert run.history[7]["objective"] == getme.history[7]["objective"]
    assert measure(run.mesh.points, mesh.hexes).n_inverted == 0
