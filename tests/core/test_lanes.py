"""Kernels that take a block of hexes at once, against the plain loops of one hex; tails of a block included."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, energies
from hexmend.kernels import hexahedron, objective
from hexmend.quality.measure import read_only
from tests.core.grids import grid, scrambled

#: One hex, a part of a block, one block and a hex, more than a chunk.
COUNTS = [1, 63, 65, 300]


def some(count, amplitude, seed):
    """`count` hexes of a scrambled grid, and its points in mean edge lengths."""
    mesh = scrambled(grid(7), amplitude, seed)
    return read_only(mesh.points / mesh.mean_edge_length), read_only(mesh.hexes[:count])


cases = {
    "count": st.sampled_from(COUNTS),
    "case": st.sampled_from([(0.15, 0.0), (0.15, 0.1), (0.9, 0.02), (3.0, 0.5)]),
    "p": st.sampled_from([1.0, 2.0, 3.5]),
    "seed": st.integers(0, 2**32 - 1),
}


@given(**cases)
def test_energy_and_gradient_are_those_of_the_plain_loop(count, case, p, seed):
    points, hexes = some(count, case[0], seed)
    delta = case[1]
    blocks, g = np.full((count, 8, 3), np.nan), np.empty((8, 3))
    objective.gradient(points, hexes, delta, p, blocks)
    eta = energies(points, hexes, delta)
    for h in range(count):
        energy = hexahedron.gradient(points[hexes[h]], delta, g)
        expected = hexahedron.weights(energy, p)[0] * g
        assert eta[h] == pytest.approx(max(energy, 0), rel=1e-12, abs=1e-14)
        np.testing.assert_allclose(blocks[h], expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


@given(**cases)
def test_the_product_is_that_of_the_plain_loop(count, case, p, seed):
    points, hexes = some(count, case[0], seed)
    delta = case[1]
    random = np.random.default_rng(seed)
    values = random.normal(size=(len(points) // 2, 3))
    slots = np.where(hexes % 2 == 0, hexes // 2, -1).astype(np.int32)  # odd nodes are fixed
    slots[slots >= len(values)] = -1
    blocks, g, hv = np.full((count, 8, 3), np.nan), np.empty((8, 3)), np.empty((8, 3))
    objective.hessian_product(points, hexes, slots, values, delta, p, blocks)
    for h in range(count):
        v = np.where(slots[h][:, None] >= 0, values[slots[h]], 0.0)
        hexahedron.product(points[hexes[h]], v, delta, p, g, hv)
        np.testing.assert_allclose(blocks[h], hv, rtol=1e-10, atol=1e-11 * max(np.abs(hv).max(), 1e-300))


@given(st.floats(-150, 150), st.integers(0, 2**32 - 1))
def test_lengths_of_any_power_of_ten_give_the_same_energy(power, seed):
    points, hexes = some(8, 0.2, seed)
    scaled = read_only(points * 10.0 ** (power / 2))
    np.testing.assert_allclose(energies(scaled, hexes), energies(points, hexes), rtol=1e-9, atol=1e-12)


def test_flat_and_inverted_hexes_have_infinite_energy_and_no_other_has():
    mesh = scrambled(grid(5), 0.1)
    points = mesh.points.copy()
    points[mesh.hexes[7, 4:]] = points[mesh.hexes[7, :4]]  # flat: every corner's sigma is exactly zero
    eta = energies(points, mesh.hexes)
    touched = np.isin(mesh.hexes, mesh.hexes[7, 4:]).any(axis=1)
    assert eta[7] == np.inf
    assert np.isfinite(eta[~touched]).all()
    assert np.isfinite(energies(points, mesh.hexes, 0.01)).all()


def test_a_batch_of_no_hexes_is_none():
    energy = MeshEnergy(grid(2))
    assert energies(energy.mesh.points, np.empty((0, 8), np.int32)).shape == (0,)
