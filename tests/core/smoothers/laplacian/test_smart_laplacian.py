"""Moves that do harm are taken back, one by one: no hex that was sound at a sweep's start is inverted at its end."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, gallery, measure
from tests.core.grids import grid, scrambled

Smart = METHODS["smart-laplacian"]


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.4, 0.8, 1.2]), st.sampled_from(["inversion", "quality"]))
def test_sound_hexes_stay_sound_in_every_sweep(seed, amplitude, guard):
    mesh = scrambled(grid(4), amplitude, seed)
    steps = Smart(guard=guard).steps(mesh)
    before = measure(next(steps).points, mesh.hexes)
    for _ in range(3):
        after = measure(next(steps).points, mesh.hexes)
        assert not (after.inverted & ~before.inverted).any()
        if guard == "quality":
            assert after.q.min() >= before.q.min() - 1e-12
        before = after


def test_where_no_move_does_harm_every_node_goes_to_the_mean_of_its_neighbours():
    mesh = scrambled(grid(3), 0.05, 1)
    smart, plain = (METHODS[name]().steps(mesh) for name in ("smart-laplacian", "laplacian"))
    next(smart), next(plain)
    step = next(smart)
    assert step.diagnostics["rejected_steps"] == 0
    np.testing.assert_array_equal(step.points, next(plain).points)


@pytest.mark.parametrize("guard", ["inversion", "quality"])
def test_a_sweep_rejects_the_moves_that_harm_one_of_all_hexes_at_the_node(guard):
    mesh = scrambled(gallery.make("five-side", size=250), 0.9, 5)
    assert np.diff(mesh.topology.node_corners.start)[mesh.free].max() > 8  # more than the lanes of a register
    points, rejected = mesh.points.copy(), 0
    for i in np.flatnonzero(mesh.free):
        attached = mesh.hexes[mesh.topology.node_corners[i] // 8]
        was, old = measure(points, attached), points[i].copy()
        points[i] = points[mesh.topology.rings[i]].mean(axis=0)
        now = measure(points, attached)
        if (now.inverted & ~was.inverted).any() or (guard == "quality" and now.q.min() < was.q.min()):
            points[i], rejected = old, rejected + 1
    steps = Smart(guard=guard).steps(mesh)
    next(steps)
    step = next(steps)
    assert 0 < rejected == step.diagnostics["rejected_steps"]
    np.testing.assert_allclose(step.points, points, rtol=1e-12)
