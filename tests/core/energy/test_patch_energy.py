"""The energy of a node's patch against that of whole hexes, and its gradient against differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm, energies
from hexmend.kernels import local
from tests.core.grids import grid, scrambled


def patch_of(mesh, node, delta, norm=SQUARES):
    """Return a patch's corners at the node, and its energy there."""
    star = mesh.topology.node_corners[node]
    return star, local.patch_energy(mesh.points, mesh.hexes, star, 0.0, delta, norm)


def value(mesh, star, scale, y, delta, norm):
    curve = np.array([[1.0, np.nan]])
    local.energy_along(mesh.points, mesh.hexes, star, scale, y, delta, norm, curve)
    return curve[0, 1]


POWERS = st.builds(ObjectiveNorm, st.sampled_from([1.0, 2.0, 3.5]), st.sampled_from([1.0, 0.0]))
CASES = st.tuples(st.integers(0, 2**32 - 1), st.sampled_from([0.1, 0.4, 0.9]), POWERS, st.booleans())


@given(CASES)
def test_value_is_the_energy_of_the_attached_hexes(case):
    seed, amplitude, norm, soft = case
    mesh = scrambled(grid(3), amplitude, seed)
    delta = 0.05 if soft else 0.0
    node = int(np.flatnonzero(mesh.free)[seed % 8])
    star, patch = patch_of(mesh, node, delta)
    scale = patch.factor
    y = np.random.default_rng(seed).uniform(-0.2, 0.2, 3)
    points = mesh.points.copy()
    points[node] += y / scale
    attached = mesh.hexes[mesh.topology.node_corners[node] // 8]
    expected = (energies(points * scale, attached, delta, None, norm.offset) ** norm.p).sum()
    got = value(mesh, star, scale, y, delta, norm)
    assert got == pytest.approx(expected, rel=1e-9)


@given(CASES)
def test_gradient_and_hessian_are_rows_and_blocks_of_the_meshs(case):
    seed, amplitude, norm, soft = case
    mesh = scrambled(grid(3), amplitude if soft else 0.15, seed)
    k = seed % 8
    energy = MeshEnergy(mesh, norm)
    node = int(energy.nodes[k])
    unit = 0.05 if soft else 0.0  # of the patch
    _, patch = patch_of(mesh, node, unit, norm)
    x, ratio = energy.to_edge_units(mesh.points), patch.factor * energy.unit
    delta = unit / ratio**3
    np.testing.assert_allclose(np.multiply(patch.gradient, ratio), energy.gradient(x, delta)[k], rtol=1e-9, atol=1e-9)
    block = energy.hessian(x, delta).assembled(np.float64).diagonal_blocks[k]
    np.testing.assert_allclose(np.multiply(patch.hessian, ratio**2), block, rtol=1e-8, atol=1e-9 * np.abs(block).max())
