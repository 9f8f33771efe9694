"""Laplacian sweeps by wavefronts have the bits of sweeps in place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.kernels import laplacian
from hexmend.smoothers.visit_order import ORDERS
from tests.core.grids import grid, scrambled


def assert_equal_sweeps(points, start, items, nodes, sweeps=3):
    expected, found = points.copy(), np.full_like(points, np.nan)
    fast = laplacian.LaplacianSweeps(points, start, items, nodes)
    for _ in range(sweeps):
        laplacian.in_place(expected, start, items, nodes)
        fast.next(found)
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("order", ["natural", "reverse", "inward", "colour", "random"])
@pytest.mark.parametrize("mesh", [scrambled(grid(5), 0.4), make("five-side", size=600), make("plane", size=2000)])
def test_every_order_of_the_free_nodes(mesh, order):
    ring = mesh.topology.rings
    assert_equal_sweeps(mesh.points, ring.start, ring.items, ORDERS[order](mesh)(mesh.points, 0))


@given(st.integers(0, 2**32 - 1))
def test_rings_of_which_only_one_node_is_in_the_others(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 30))
    rings = [rng.permutation(n)[: rng.integers(1, n + 1)] for _ in range(n)]
    start = np.cumsum([0, *map(len, rings)]).astype(np.int32)
    items = np.concatenate(rings).astype(np.int32)
    nodes = rng.permutation(n)[: rng.integers(0, n + 1)].astype(np.int32)
    assert_equal_sweeps(rng.normal(size=(n, 3)), start, items, nodes)
