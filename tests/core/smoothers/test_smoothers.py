"""What sets the methods apart."""

import itertools

import numpy as np

from hexmend import Laplacian, LocalSteepestDescent, SmartLaplacian, StoppingCriteria, measure, smooth
from hexmend.gallery import make
from tests.core.grids import grid, scrambled


def after(mesh, smoother, steps=1):
    """Return the points after some iterations."""
    return next(itertools.islice(smoother.steps(mesh), steps, None)).points


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


def test_local_sd_with_a_higher_p_ends_with_a_better_worst_hex():
    mesh = make("five-side", size=700)
    least = [
        smooth(mesh, LocalSteepestDescent(p=p), StoppingCriteria(tolerance=1e-5)).after.q_min for p in (1.0, 2.0, 8.0)
    ]
    assert least == sorted(least)
    assert least[2] > least[0] + 1e-3
