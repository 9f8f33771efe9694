"""What sets the methods apart."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.quality import measure
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers.laplacian.laplacian import Laplacian
from hexmend.smoothers.laplacian.smart_laplacian import SmartLaplacian
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from tests.core.grids import grid, scrambled


def after(mesh, smoother, steps):
    return next(itertools.islice(smoother.steps(mesh), steps, None)).points


def test_laplacian_in_place_is_algorithm_3_1():
    mesh = scrambled(grid(3), 0.3)
    points = mesh.points.copy()
    for i in np.flatnonzero(mesh.free):
        points[i] = points[mesh.topology.rings[i]].mean(axis=0)
    np.testing.assert_allclose(after(mesh, Laplacian(), 1), points, rtol=1e-14)


def test_laplacian_simultaneous_looks_at_the_old_places():
    mesh = scrambled(grid(3), 0.3)
    points = mesh.points.copy()
    for i in np.flatnonzero(mesh.free):
        points[i] = mesh.points[mesh.topology.rings[i]].mean(axis=0)
    np.testing.assert_allclose(after(mesh, Laplacian(update="simultaneous"), 1), points, rtol=1e-14)


def test_laplacian_inverts_hexes_on_bridge_sharp_and_smart_laplacian_does_not():
    mesh = make("bridge-sharp", size=4000)
    assert measure(mesh.points, mesh.hexes).n_inverted == 0
    assert smooth(mesh, Laplacian(), StoppingCriteria(max_iterations=400, keep_last=True)).after.inverted > 0
    assert smooth(mesh, SmartLaplacian(), StoppingCriteria(max_iterations=60)).after.inverted == 0


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 1.0))
def test_smart_laplacian_never_inverts_a_hex_that_was_sound(seed, amplitude):
    mesh = scrambled(grid(4), amplitude, seed)
    was = measure(mesh.points, mesh.hexes).inverted
    for step in itertools.islice(SmartLaplacian().steps(mesh), 4):
        now = measure(step.points, mesh.hexes).inverted
        assert not (now & ~was).any()
        was = now


@given(st.integers(0, 2**32 - 1))
def test_guarding_quality_never_lowers_the_least(seed):
    mesh = scrambled(grid(4), 0.35, seed)
    least = [
        measure(s.points, mesh.hexes).q.min() for s in itertools.islice(SmartLaplacian(guard="quality").steps(mesh), 5)
    ]
    assert (np.diff(least) >= -1e-12).all()


def test_smart_laplacian_is_laplacian_where_nothing_is_harmed():
    mesh = scrambled(grid(4), 0.1)
    np.testing.assert_array_equal(after(mesh, SmartLaplacian(), 3), after(mesh, Laplacian(), 3))


@given(st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 4.0]))
def test_local_sd_lowers_the_objective_and_never_leaves_the_feasible_region(seed, p):
    mesh = scrambled(grid(4), 0.2, seed)
    if measure(mesh.points, mesh.hexes).n_inverted:
        return
    eta = [measure(s.points, mesh.hexes).eta for s in itertools.islice(LocalSteepestDescent(p=p).steps(mesh), 6)]
    values = [(e**p).sum() for e in eta]
    assert np.isfinite(values).all()
    assert (np.diff(values) <= 1e-12).all()


@pytest.mark.parametrize("seed", range(4))
def test_local_sd_untangles_a_scrambled_cube_back_to_the_perfect_grid(seed):
    mesh = make("cube", size=216, scramble=0.9, seed=seed)
    assert measure(mesh.points, mesh.hexes).n_inverted > 20
    result = smooth(mesh, "local-sd", StoppingCriteria(tolerance=1e-7))
    assert result.after.inverted == 0
    assert result.after.q_min == pytest.approx(1, abs=1e-8)


def test_local_sd_with_a_higher_p_ends_with_a_better_worst_hex():
    mesh = make("five-side", size=700)
    least = [
        smooth(mesh, LocalSteepestDescent(p=p), StoppingCriteria(tolerance=1e-5)).after.q_min for p in (1.0, 2.0, 8.0)
    ]
    assert least == sorted(least)
    assert least[2] > least[0] + 1e-3
