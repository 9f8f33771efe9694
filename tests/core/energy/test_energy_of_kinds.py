"""Energy and barriers of wedges, pyramids and tetrahedra: values by the formula, derivatives by differences.

The energy of a node's patch against that of whole hexes, and its gradient against differences.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm, energies
from hexmend.kernels import local
from hexmend.mesh.element_target import Target
from hexmend.mesh.solid_cells import SOLID_KINDS, kinds_of
from hexmend.optimise.floors.movable_hexes import MovableHeights, MovableHexes
from hexmend.quality import measure
from hexmend.target import make_target
from tests.core.grids import grid, scrambled
from tests.core.solid_lattices import honeycomb, mixed, prisms, single

MESHES = {"prisms": prisms, "honeycomb": honeycomb, "mixed": mixed}
of_lattices = pytest.mark.parametrize("name", MESHES)


def eta_of(kind, x, delta=0.0, offset=1.0):
    """eta of a cell at its nodes x, as the book writes it of hexes, with S W^-1 in place of S."""
    edges = np.stack([x[kind.corners[:, k]] - x[kind.corners[:, 0]] for k in (1, 2, 3)], axis=2)
    shapes = edges @ np.linalg.inv(kind.ideal)
    sigma = np.linalg.det(shapes)
    h = (sigma + np.sqrt(sigma**2 + 4 * delta**2)) / 2
    return ((shapes**2).sum(axis=(1, 2)) / (3 * h ** (2 / 3))).mean() - offset


def difference(of, energy, x, way, step=1e-6):
    return (of(energy.moved(x, way, step)) - of(energy.moved(x, way, -step))) / (2 * step)


@pytest.mark.parametrize("kind", SOLID_KINDS, ids=lambda kind: kind.name)
def test_energy_and_quality_of_a_cell_are_those_of_the_formula(kind):
    ideal = single(kind)
    mesh = ideal.with_points(ideal.points + np.random.default_rng(3).uniform(-0.1, 0.1, ideal.points.shape))
    quality, x = measure(mesh.points, mesh.elements), mesh.points[mesh.elements[0, : kind.nodes]]
    assert quality.eta[0] == pytest.approx(eta_of(kind, x))
    edges = np.stack([x[kind.corners[:, k]] - x[kind.corners[:, 0]] for k in (1, 2, 3)], axis=2)
    shapes = edges @ np.linalg.inv(kind.ideal)
    sigma = np.linalg.det(shapes)
    assert quality.sigma[0] == pytest.approx(sigma.min())
    assert quality.q[0] == pytest.approx((3 * np.cbrt(sigma) ** 2 / (shapes**2).sum(axis=(1, 2))).mean())
    lengths = np.linalg.norm(edges, axis=1).prod(axis=1) / np.linalg.norm(kind.ideal, axis=0).prod()
    assert quality.scaled_jacobian[0] == pytest.approx((sigma / lengths).min())


@of_lattices
@pytest.mark.parametrize(("p", "offset"), [(1.0, 1.0), (2.0, 0.0), (3.5, 0.4)])
@pytest.mark.parametrize("delta", [0.0, 0.3])
def test_derivatives_of_a_mesh_are_those_of_differences(name, p, offset, delta):
    mesh = scrambled(MESHES[name](4), 0.1 if delta == 0 else 0.5, 1)
    energy = MeshEnergy(mesh, ObjectiveNorm(p, offset))
    x, way = energy.to_edge_units(mesh.points), np.random.default_rng(0).normal(size=(energy.nodes.size, 3))
    slope = difference(lambda y: energy.value(y, delta), energy, x, way)
    assert np.vdot(energy.gradient(x, delta), way) == pytest.approx(slope, rel=1e-5, abs=1e-6)
    expected = difference(lambda y: energy.gradient(y, delta), energy, x, way).ravel()
    hessian, bound = energy.hessian(x, delta), 1e-5 * np.abs(expected).max()
    np.testing.assert_allclose(hessian @ way.ravel(), expected, rtol=1e-4, atol=bound)
    np.testing.assert_allclose(hessian.assembled(np.float64) @ way.ravel(), expected, rtol=1e-4, atol=bound)


@of_lattices
def test_the_value_is_the_sum_over_the_cells(name):
    mesh = scrambled(MESHES[name](4), 0.1)
    energy = MeshEnergy(mesh, ObjectiveNorm(2.0))
    x = energy.to_edge_units(mesh.points)
    kinds = kinds_of(mesh.elements)
    eta = [eta_of(SOLID_KINDS[k], x[row[: SOLID_KINDS[k].nodes]]) for k, row in zip(kinds, mesh.elements, strict=True)]
    assert energy.value(x) == pytest.approx(np.square(eta).sum(), rel=1e-9)


@of_lattices
@pytest.mark.parametrize("weight", [0.0, 0.7])
def test_derivatives_with_a_target_are_those_of_differences(name, weight):
    mesh = MESHES[name](4)
    mesh = scrambled(mesh.with_points(mesh.points * [1, 1, 2]), 0.1)
    lengths = make_target(mesh, "given").lengths
    energy = MeshEnergy(mesh.with_element_target(Target(lengths, weight)), ObjectiveNorm(2.0))
    x, way = energy.to_edge_units(mesh.points), np.random.default_rng(0).normal(size=(energy.nodes.size, 3))
    assert np.vdot(energy.gradient(x), way) == pytest.approx(difference(energy.value, energy, x, way), rel=1e-5)
    expected = difference(energy.gradient, energy, x, way).ravel()
    product = energy.hessian(x).assembled(np.float64) @ way.ravel()
    np.testing.assert_allclose(product, expected, rtol=1e-4, atol=1e-5 * np.abs(expected).max())


def test_prisms_stretched_along_their_edges_are_what_their_given_shape_wants():
    mesh = prisms(3)
    mesh = mesh.with_points(mesh.points * [1, 1, 3])
    lengths = make_target(mesh, "given-shape").lengths
    np.testing.assert_allclose(lengths, np.tile([1, 1, 3], (mesh.n_elements, 1)))
    energy = MeshEnergy(mesh.with_element_target(Target(lengths)), ObjectiveNorm(2.0))
    assert energy.value(energy.to_edge_units(mesh.points)) == pytest.approx(0, abs=1e-12)


@of_lattices
@pytest.mark.parametrize(
    "values", [MovableHexes, lambda energy: MovableHeights(energy, 0.5)], ids=["jacobians", "heights"]
)
def test_barriers_of_floors_have_the_derivatives_of_differences(name, values):
    mesh = scrambled(MESHES[name](4), 0.15, 2)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    x, movable = energy.to_edge_units(mesh.points), values(energy)
    least = float(movable.corners(x).min())
    assert least == pytest.approx(movable.jacobians(x).min())
    quality = -np.inf if values is not MovableHexes else float(movable.qualities(x).min()) - 0.05
    raised = energy.with_barrier(movable.barrier(least - 0.05, quality, 0.6, 0.6, 3.0))
    way = np.random.default_rng(0).normal(size=(energy.nodes.size, 3))
    slope = difference(raised.value, energy, x, way)
    assert np.vdot(raised.gradient(x), way) == pytest.approx(slope, rel=1e-5)
    assert raised.value(x) > energy.value(x) + 1
    if values is MovableHexes:
        expected = difference(raised.gradient, energy, x, way).ravel()
        product = raised.hessian(x).assembled(np.float64) @ way.ravel()
        np.testing.assert_allclose(product, expected, rtol=1e-3, atol=1e-4 * np.abs(expected).max())


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
