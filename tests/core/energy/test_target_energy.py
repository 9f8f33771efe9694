"""Energies against a target: invariance, derivatives against differences, and agreement of all kernels."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm, energies
from hexmend.energy.target import wanted_lengths
from hexmend.kernels import local, objective
from hexmend.kernels.line_search import LineSearch
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.element_target import Target
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from hexmend.quality import measure
from tests.core.energy.test_derivatives import check_mesh
from tests.core.grids import grid, scrambled
from tests.core.native import extension

scalar_reference = extension.scalar_reference()

seeds = st.integers(0, 2**32 - 1)
weights = st.sampled_from([0.0, 0.7])
powers = st.builds(ObjectiveNorm, st.sampled_from([1.0, 1.5, 2.0, 3.5]), st.sampled_from([1.0, 0.4, 0.0]))
HEX, WHOLE = np.arange(8, dtype=np.int32)[None], np.zeros(1, np.uint8)
#: Direction of the hex of each edge of the corner tetrahedra, (8, 3).
DIRECTIONS = np.array(
    [[np.flatnonzero(UNIT_CUBE[t[0]] != UNIT_CUBE[end])[0] for end in t[1:]] for t in CORNER_TETRAHEDRA]
)


def eta_of(x, lengths, weight, delta):
    """eta(H) against the target before it is clamped, as formulas say it; x may be complex."""
    edges = np.stack([x[CORNER_TETRAHEDRA[:, k]] - x[CORNER_TETRAHEDRA[:, 0]] for k in (1, 2, 3)], axis=2)
    edges = edges / lengths[DIRECTIONS][:, None, :]
    sigma = np.linalg.det(edges)
    h = (sigma + np.sqrt(sigma * sigma + 4 * delta * delta)) / 2
    shape = (edges * edges).sum(axis=(1, 2)) / (3 * h ** (2 / 3))
    return (shape + weight * ((h + 1 / h) / 2 - 1)).mean() - 1


def complex_gradient(x, *args):
    gradient = np.empty((8, 3))
    for place in np.ndindex(8, 3):
        there = x.astype(complex)
        there[place] += 1e-40j
        gradient[place] = eta_of(there, *args).imag / 1e-40
    return gradient


@st.composite
def cases(draw):
    """Corners of a hex with lengths of its target, weight of the size and delta; sound, softened or tangled."""
    random = np.random.default_rng(draw(seeds))
    kind = draw(st.sampled_from(["sound", "soft", "tangled", "flat"]))
    lengths = 10 ** random.uniform(-2, 2, 3)
    x = UNIT_CUBE + (1.6 if kind == "tangled" else 0.3) * random.uniform(-0.5, 0.5, (8, 3))
    if kind == "flat":
        x[1] = x[0]
    delta = 0.0 if kind == "sound" else draw(st.sampled_from([0.02, 0.1, 0.5]))
    if kind == "sound":
        assume(np.linalg.det(x[CORNER_TETRAHEDRA[:, 1:]] - x[CORNER_TETRAHEDRA[:, :1]]).min() > 0.02)
    return x * lengths, lengths, draw(weights), delta


@given(cases(), st.sampled_from([objective, scalar_reference]))
def test_energy_and_gradient_of_a_hex_are_those_of_the_formulas(case, kernels):
    x, lengths, weight, delta = case
    target = TargetMatrices(1 / lengths[None], weight)
    expected = eta_of(x, lengths, weight, delta)
    assume(expected > 1e-9)
    eta, shares = np.empty(1), np.empty((1, 8, 3))
    kernels.energies(x, HEX, delta, 1.0, WHOLE, eta, target)
    assert eta[0] == pytest.approx(expected, rel=1e-9)
    kernels.gradient(x, HEX, delta, (1.0, 1.0), WHOLE, shares, target)
    slopes = complex_gradient(x, lengths, weight, delta)
    np.testing.assert_allclose(
        shares[0] * lengths, slopes * lengths, rtol=1e-8, atol=1e-9 * np.abs(slopes * lengths).max()
    )


@given(cases(), seeds, powers, st.sampled_from([objective, scalar_reference]))
def test_hessian_of_a_hex_is_that_of_differences(case, seed, norm, kernels):
    x, lengths, weight, delta = case
    p, offset = norm
    assume(eta_of(x, lengths, weight, delta) > 1e-2)
    v = lengths * np.random.default_rng(seed).normal(size=(8, 3))

    def slopes(y):
        value = eta_of(y, lengths, weight, delta) + 1 - offset
        return p * value ** (p - 1) * complex_gradient(y, lengths, weight, delta)

    step = 1e-4 * max(delta, 0.02) / np.abs(v / lengths).max()
    coarse, fine = ((slopes(x + h * v) - slopes(x - h * v)) / (2 * h) for h in (2 * step, step))
    expected = (4 * fine - coarse) / 3 * lengths
    shares = np.empty((1, 8, 3))
    kernels.hessian_product(x, HEX, HEX, v, delta, norm, WHOLE, shares, TargetMatrices(1 / lengths[None], weight))
    np.testing.assert_allclose(shares[0] * lengths, expected, rtol=2e-5, atol=2e-6 * np.abs(expected).max())


def aimed(seed, amplitude, weight, n=3):
    """Scrambled lattice with lengths that differ from hex to hex."""
    random = np.random.default_rng(seed)
    mesh = scrambled(grid(n), amplitude, seed)
    mesh = mesh.with_points(mesh.points * [1, 0.3, 2])
    lengths = random.uniform(0.5, 2, (mesh.n_hexes, 3)) * [1, 0.3, 2]
    return mesh.with_element_target(Target(lengths, weight))


@given(seeds, powers, st.sampled_from([0.0, 0.05]), weights)
def test_derivatives_of_a_mesh_are_those_of_differences(seed, norm, delta, weight):
    mesh = aimed(seed, 0.2 if delta == 0 else 0.8, weight)
    assume(delta > 0 or measure(mesh.points, mesh.hexes).q.min() > 0.1)
    v, hessian, product = check_mesh(MeshEnergy(mesh, norm), delta, seed, rtol=1e-4)
    size = np.abs(product).max()
    np.testing.assert_allclose(hessian.assembled(np.float64) @ v, product, rtol=1e-9, atol=1e-10 * size)


@given(seeds, powers, st.sampled_from([0.0, 0.05]), weights)
def test_a_nodes_patch_has_the_energy_and_derivatives_of_the_mesh(seed, norm, delta, weight):
    mesh = aimed(seed, 0.15 if delta == 0 else 0.8, weight)
    energy = MeshEnergy(mesh, norm)
    k = seed % 8
    node = int(energy.nodes[k])
    star, target = mesh.topology.node_corners[node], TargetMatrices(1 / wanted_lengths(mesh), weight)
    patch = local.patch_energy(mesh.points, mesh.hexes, star, 0.0, delta, norm, target)
    ratio, x = patch.factor * energy.unit, energy.to_edge_units(mesh.points)
    value = (energies(mesh.points, mesh.hexes, delta, None, norm.offset, target)[star // 8] ** norm.p).sum()
    assert patch.value == pytest.approx(value, rel=1e-9)
    gradient = energy.gradient(x, delta)[k]
    np.testing.assert_allclose(np.multiply(patch.gradient, ratio), gradient, rtol=1e-8, atol=1e-9 * max(1, value))
    block = energy.hessian(x, delta).assembled(np.float64).diagonal_blocks[k]
    np.testing.assert_allclose(np.multiply(patch.hessian, ratio**2), block, rtol=1e-8, atol=1e-9 * np.abs(block).max())
    curve = np.array([[0.0, 0.0], [0.05, 0.0]])
    step = np.array([0.3, -0.2, 0.4])
    local.energy_along(mesh.points, mesh.hexes, star, patch.factor, step, delta, norm, curve, target)
    points = mesh.points.copy()
    points[node] += 0.05 * step / patch.factor
    moved = (energies(points, mesh.hexes, delta, None, norm.offset, target)[star // 8] ** norm.p).sum()
    np.testing.assert_allclose(curve[:, 1], [patch.value, moved], rtol=1e-8)


@given(seeds, weights, st.sampled_from([0.0, 0.05]))
def test_a_sweep_is_that_of_the_scalar_reference(seed, weight, delta):
    mesh = aimed(seed, 0.15 if delta == 0 else 0.8, weight)
    target, colours = TargetMatrices(1 / wanted_lengths(mesh), weight), mesh.topology.colouring(mesh.free)
    for direction in (local.Direction.STEEPEST_DESCENT, local.Direction.MODIFIED_NEWTON):
        settings = local.NodeStepSettings(direction, delta, (2.0, 1.0), LineSearch(), target)
        one, other = mesh.points.copy(), mesh.points.copy()
        for points, sweep in ((one, local.sweep), (other, scalar_reference.sweep)):
            sweep(points, mesh.topology.hex_mesh, colours.start, colours.items, settings)
        np.testing.assert_allclose(one, other, atol=1e-7)
        assert (one != mesh.points).any()


@given(seeds, weights, st.sampled_from([0.0, 0.05]))
def test_a_stretch_of_a_lattice_and_its_lengths_changes_no_energy(seed, weight, delta):
    random, stretch = np.random.default_rng(seed), np.array([1.0, 30.0, 1e-3])
    lattice, lengths = grid(3), random.uniform(0.5, 2, (27, 3))
    ticks = np.cumsum(random.uniform(0.2, 1, (4, 3)), axis=0)  # of the planes along each axis
    points = np.take_along_axis(ticks, lattice.points.astype(int), axis=0)
    here = lattice.with_points(points).with_element_target(Target(lengths, weight))
    there = lattice.with_points(points * stretch).with_element_target(Target(lengths * stretch, weight))
    values = [
        energy.hex_energies(energy.to_edge_units(energy.mesh.points), delta)
        for energy in map(MeshEnergy, (here, there))
    ]
    np.testing.assert_allclose(*values, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("weight", [0.0, 0.5])
def test_a_mesh_like_its_target_has_no_energy_and_no_gradient(weight):
    mesh = grid(4)
    mesh = mesh.with_points(mesh.points * [1, 5, 0.01]).with_element_target(
        Target(np.tile([1, 5, 0.01], (64, 1)), weight)
    )
    energy = MeshEnergy(mesh)
    x = energy.to_edge_units(mesh.points)
    assert energy.value(x) == pytest.approx(0, abs=1e-20)
    assert np.abs(energy.gradient(x)).max() == pytest.approx(0, abs=1e-6)


@given(seeds, st.sampled_from([0.3, 2.0]))
def test_the_size_counts_for_inverted_hexes_too(seed, weight):
    """Without a minimum at infinity: the energy rises as a hex is turned further inside out."""
    lengths = np.ones(3)
    x = UNIT_CUBE + 0.2 * np.random.default_rng(seed).uniform(-1, 1, (8, 3))
    values = []
    for depth in (-0.5, -1.0, -2.0):
        y = x.copy()
        y[4:, 2] = x[:4, 2] + depth
        eta = np.empty(1)
        objective.energies(y, HEX, 0.1, 1.0, WHOLE, eta, TargetMatrices(1 / lengths[None], weight))
        values.append(eta[0])
    assert np.isfinite(values).all()
    assert values == sorted(values)
