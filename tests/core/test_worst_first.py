"""A sweep of the worst hexes ends at the best state on its way."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend.kernels import worst_first
from hexmend.mesh import Mesh
from hexmend.quality import measure
from tests.core.grids import grid, scrambled


def swept(mesh, free, rho=0.3):
    """Figures before and after a sweep of all hexes."""
    points, before = mesh.points.copy(), measure(mesh.points, mesh.hexes)
    attached, candidates = mesh.topology.node_corners, np.arange(mesh.n_hexes, dtype=np.int32)
    worst_first.sweep(
        points, mesh.hexes, attached.start, attached.items, free, candidates, before.q.copy(), ~before.inverted,
        1.0, rho, 0.001, 0.01,
    )  # fmt: skip
    np.testing.assert_array_equal(points[~free], mesh.points[~free])
    return before, measure(points, mesh.hexes)


@settings(max_examples=15)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.1, 0.3, 0.6]))
def test_no_sound_hex_is_inverted_and_where_none_is_mended_the_least_does_not_fall(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    before, after = swept(mesh, mesh.free)
    assert not (after.inverted & ~before.inverted).any()
    if after.n_inverted == before.n_inverted:
        assert after.q.min() >= before.q.min() - 1e-12


@pytest.mark.parametrize("seed", range(6))
def test_where_the_least_cannot_rise_the_mean_does(seed):
    """One hex, apart, is the worst and none of its nodes is free."""
    rough, cube = scrambled(grid(3), 0.2, seed), grid(1)
    flat = cube.points * [1, 1, 0.05] + 9
    mesh = Mesh(np.concatenate([rough.points, flat]), np.concatenate([rough.hexes, cube.hexes + rough.n_nodes]))
    free = np.concatenate([rough.free, np.zeros(8, bool)])
    before, after = swept(mesh, free)
    assert before.q.argmin() == after.q.argmin() == rough.n_hexes
    assert after.q.min() == before.q.min()
    assert after.q.sum() > before.q.sum()
