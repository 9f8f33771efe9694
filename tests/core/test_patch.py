"""The patch table against the energy of whole hexes, and its gradient against differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from hexmend.energy import MeshEnergy, energies
from hexmend.hexahedron import UNIT_CUBE
from hexmend.numba_kernels import patch
from tests.core.grids import grid, scrambled


def patch_of(mesh, node, delta):
    rows = mesh.topology.node_corners
    begin, size = rows.start[node], int(rows.start[node + 1] - rows.start[node])
    table = np.empty(patch.TABLE * patch.blocks_of(size))
    patch.load(mesh.points, mesh.hexes, rows.items, begin, size, table)
    scale = patch.rescale(table, size)
    patch.tabulate(table, size, delta)
    return table, size, float(scale)


CASES = st.tuples(
    st.integers(0, 2**32 - 1), st.sampled_from([0.1, 0.4, 0.9]), st.sampled_from([1.0, 2.0, 3.5]), st.booleans()
)


@given(CASES)
def test_value_is_the_energy_of_the_attached_hexes(case):
    seed, amplitude, p, soft = case
    mesh = scrambled(grid(3), amplitude, seed)
    delta = 0.05 if soft else 0.0
    node = int(np.flatnonzero(mesh.free)[seed % 8])
    table, size, scale = patch_of(mesh, node, delta)
    y = np.random.default_rng(seed).uniform(-0.2, 0.2, 3)
    points = mesh.points.copy()
    points[node] += y / scale
    attached = mesh.hexes[mesh.topology.node_corners[node] // 8]
    expected = (energies(points * scale, attached, delta) ** p).sum()
    got = patch.value(table, size, *y, delta, p)
    assert got == pytest.approx(expected, rel=1e-9)


@given(CASES)
def test_gradient_is_that_of_central_differences(case):
    seed, amplitude, p, soft = case
    mesh = scrambled(grid(3), amplitude if soft else 0.15, seed)
    delta = 0.05 if soft else 0.0
    node = int(np.flatnonzero(mesh.free)[seed % 8])
    table, size, _ = patch_of(mesh, node, delta)
    f, *gradient = patch.value_and_gradient(table, size, delta, p)
    assert f == pytest.approx(patch.value(table, size, 0.0, 0.0, 0.0, delta, p))
    step = 1e-6
    for k in range(3):
        y = np.zeros(3)
        y[k] = step
        rise = patch.value(table, size, *y, delta, p) - patch.value(table, size, *-y, delta, p)
        assert rise / (2 * step) == pytest.approx(gradient[k], rel=1e-5, abs=1e-5 * max(1, f))


@given(CASES)
def test_gradient_and_hessian_are_rows_and_blocks_of_the_meshs(case):
    seed, amplitude, p, soft = case
    mesh = scrambled(grid(3), amplitude if soft else 0.15, seed)
    k = seed % 8
    energy = MeshEnergy(mesh, p)
    node = int(energy.nodes[k])
    unit = 0.05 if soft else 0.0  # of the patch
    table, size, scale = patch_of(mesh, node, unit)
    delta = unit / (scale * energy.unit) ** 3
    _, *gradient = patch.value_and_gradient(table, size, unit, p)
    xx, xy, xz, yy, yz, zz = patch.hessian(table, size, p)
    x, ratio = energy.scaled(mesh.points), scale * energy.unit
    np.testing.assert_allclose(np.multiply(gradient, ratio), energy.gradient(x, delta)[k], rtol=1e-9, atol=1e-9)
    block = energy.hessian(x, delta).assembled(np.float64).own_blocks[k]
    own = np.array([xx, xy, xz, yy, yz, zz])
    np.testing.assert_allclose(own * ratio**2, block, rtol=1e-8, atol=1e-9 * np.abs(block).max())


def test_a_perfect_patch_has_no_gradient():
    mesh = grid(2)
    table, size, _ = patch_of(mesh, 13, 0.0)
    f, *gradient = patch.value_and_gradient(table, size, 0.0, 2.0)
    assert f == pytest.approx(0, abs=1e-12)
    assert gradient == pytest.approx([0, 0, 0], abs=1e-12)


def test_a_turned_hex_is_the_same_hex():
    for corner, turned in enumerate(patch.TURNED):
        assert turned[0] == corner
        x, there = UNIT_CUBE[turned], UNIT_CUBE
        np.testing.assert_array_equal(pdist(x), pdist(there))
        assert np.linalg.det(x[[1, 3, 4]] - x[0]) == pytest.approx(1)  # turned, not mirrored
