"""A sweep of the worst hexes ends at the best state on its way."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Mesh, measure
from hexmend.kernels import worst_first
from tests.core.grids import grid, scrambled


def swept(mesh, free, **more):
    """Figures before and after a sweep, and how many steps were taken back."""
    points, before = mesh.points.copy(), measure(mesh.points, mesh.hexes)
    candidates = np.flatnonzero(free[mesh.hexes].any(axis=1)).astype(np.int32)
    values = {"scaling": 1.0, "relaxation": 0.3, "penalty": 0.001, "rejection_penalty": 0.01} | more
    step, q, sound = worst_first.WorstFirstSettings(**values), before.q.copy(), ~before.inverted
    rejected = worst_first.sweep(points, mesh.topology.hex_mesh, free, candidates, q, sound, step)
    np.testing.assert_array_equal(points[~free], mesh.points[~free])
    return before, measure(points, mesh.hexes), rejected


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.1, 0.3, 0.6]))
def test_no_sound_hex_is_inverted_and_where_none_is_mended_the_least_does_not_fall(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    before, after, _ = swept(mesh, mesh.free)
    assert not (after.inverted & ~before.inverted).any()
    if after.n_inverted == before.n_inverted:
        assert after.q.min() >= before.q.min() - 1e-12


@pytest.mark.parametrize("seed", range(6))
def test_where_the_least_cannot_rise_the_mean_does(seed):
    """Two flat hexes, apart, are the worst, and a step of one would invert the other."""
    rough, flat = scrambled(grid(3), 0.3, seed), grid(1, 1, 2)
    points = np.concatenate([rough.points, flat.points * [1, 1, 0.02] + 9])
    mesh = Mesh(points, np.concatenate([rough.hexes, flat.hexes + rough.n_nodes]))
    free = np.concatenate([rough.free, np.arange(12) == 4])
    before, after, rejected = swept(mesh, free, penalty=1.0, rejection_penalty=2.0)
    assert rejected >= 2
    assert after.q.min() == before.q.min() == before.q[-2:].min()
    assert after.q.sum() > before.q.sum()
