"""Barrier of floors: its values by the formula, its derivatives by differences, and where it is infinite or nothing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.mesh.element_target import Target
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
#: Sizes that count in a target, and None: no target.
weights = st.sampled_from([None, 0.0, 0.7])
kinds = st.sampled_from(["jacobians", "qualities", "both"])
DIRECTIONS = np.array(
    [[np.flatnonzero(UNIT_CUBE[t[0]] != UNIT_CUBE[end])[0] for end in t[1:]] for t in CORNER_TETRAHEDRA]
)


def b(y):
    """The barrier of one value with weight 1."""
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = -np.log(y) + (y - 1) - (y - 1) ** 2 / 2
    return np.where(y <= 0, np.inf, np.where(y < 1, inside, 0.0))


def edges_of(x, hexes):
    """Edges of the corner tetrahedra as columns, (m, 8, 3, 3)."""
    tets = x[hexes[:, CORNER_TETRAHEDRA]]
    return np.stack([tets[:, :, k] - tets[:, :, 0] for k in (1, 2, 3)], axis=3)


def jacobians_of(x, hexes):
    edges = edges_of(x, hexes)
    return np.linalg.det(edges) / np.linalg.norm(edges, axis=2).prod(axis=2)


def qualities_of(x, hexes, omitted, lengths=None, weight=0.0):
    """q(H), with a target that of S W^-1; omitted corners count as perfect."""
    edges = edges_of(x, hexes)
    if lengths is not None:
        edges = edges / lengths[:, DIRECTIONS][:, :, None, :]
    sigma = np.linalg.det(edges)
    eta = (edges**2).sum(axis=(2, 3)) / (3 * np.cbrt(sigma) ** 2) + weight * ((sigma + 1 / sigma) / 2 - 1)
    return np.where(corners(omitted), 1.0, 1 / eta).mean(axis=1)


def corners(bits):
    """The corners that are set in bits (m,), (m, 8) bool."""
    return np.unpackbits(bits[:, None], axis=1, bitorder="little").astype(bool)


def case_of(seed, weight=None, kind="both"):
    """Make an energy with a barrier in whose bands about half of the values are, and positions."""
    random = np.random.default_rng(seed)
    mesh = scrambled(grid(3), 0.15, seed)
    mesh = mesh.with_fixed(random.uniform(size=mesh.n_nodes) < 0.3)
    lengths = None if weight is None else random.uniform(0.7, 1.4, (mesh.n_hexes, 3))
    if weight is not None:
        mesh = mesh.with_element_target(Target(lengths, weight))
    omitted = np.where(random.uniform(size=mesh.n_hexes) < 0.3, 1 << random.integers(0, 8, mesh.n_hexes), 0)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0), omitted.astype(np.uint8))
    x = energy.to_edge_units(mesh.points)
    ignored = np.where(random.uniform(size=mesh.n_hexes) < 0.5, random.integers(0, 256, mesh.n_hexes), 0)
    own = None if weight is None else lengths / energy.unit
    jacobians = jacobians_of(x, mesh.hexes)
    qualities = qualities_of(x, mesh.hexes, energy.omitted, own, weight or 0.0)
    low = jacobians.min() - 0.1, qualities.min() - 0.1
    bands = np.median(jacobians) - low[0], np.median(qualities) - low[1]
    floors = [np.full(mesh.n_hexes, one) for one in low]
    floors[0][random.uniform(size=mesh.n_hexes) < 0.2] = -np.inf
    floors[1][random.uniform(size=mesh.n_hexes) < 0.2] = -np.inf
    if kind != "both":
        floors[kind == "jacobians"][:] = -np.inf
    barrier = FloorBarrier(*floors, ignored.astype(np.uint8), *bands, 3.0)
    expected = np.where(corners(barrier.ignored), 0.0, b((jacobians - floors[0][:, None]) / bands[0])).sum(axis=1)
    expected = 3.0 * (expected + b((qualities - floors[1]) / bands[1]))
    return energy.with_barrier(barrier), x, expected


@given(seeds, weights, kinds)
def test_its_values_are_those_of_the_formula(seed, weight, kind):
    energy, x, expected = case_of(seed, weight, kind)
    assert (expected > 0).sum() > 5
    np.testing.assert_allclose(energy.barriers(x), expected, rtol=1e-9, atol=1e-12)
    without = energy.with_barrier(None)
    assert energy.value(x) == pytest.approx(without.value(x) + expected.sum(), rel=1e-12)
    assert without.barriers(x) == 0


@given(seeds, weights, kinds)
def test_its_derivatives_are_those_of_differences(seed, weight, kind):
    energy, x, _ = case_of(seed, weight, kind)
    v = np.random.default_rng(seed + 1).normal(size=(energy.nodes.size, 3))
    gradient, hessian = energy.gradient(x), energy.hessian(x)

    def difference(of, step):
        return (of(energy.moved(x, step * v)) - of(energy.moved(x, -step * v))) / (2 * step)

    assert np.vdot(gradient, v) == pytest.approx(difference(energy.value, 1e-6), rel=1e-5, abs=1e-6)
    expected = difference(energy.gradient, 1e-6).ravel()
    product = hessian.assembled(np.float64) @ v.ravel()
    np.testing.assert_allclose(product, expected, rtol=1e-4, atol=2e-5 * np.abs(expected).max())
    np.testing.assert_allclose(hessian @ v.ravel(), product, rtol=1e-12)
    single = hessian.assembled(np.float32) @ v.ravel()
    np.testing.assert_allclose(single, product, rtol=1e-4, atol=1e-4 * np.abs(product).max())


@pytest.mark.parametrize(("seed", "weight"), [(0, None), (1, 0.7)])
def test_hexes_above_their_bands_take_no_part_in_the_hessian(seed, weight):
    energy, x, _ = case_of(seed, weight)
    barrier, share = energy.barrier, 0.7
    bands = barrier.jacobian_band * share, barrier.quality_band * share
    low = FloorBarrier(barrier.jacobians, barrier.qualities, barrier.ignored, *bands, 3.0)
    near = energy.with_barrier(low).barriers(x) > 0
    assert 0 < near.sum() < 0.8 * near.size
    floors = [np.where(near, one, -np.inf) for one in (barrier.jacobians, barrier.qualities)]
    energies = [energy.with_barrier(one) for one in (low, FloorBarrier(*floors, barrier.ignored, *bands, 3.0))]
    for dtype in (np.float32, np.float64):
        found, expected = (one.hessian(x).assembled(dtype) for one in energies)
        np.testing.assert_array_equal(found.off_diagonal, expected.off_diagonal)
        np.testing.assert_array_equal(found.diagonal, expected.diagonal)


def test_at_a_floor_and_below_it_is_infinite_and_above_the_band_nothing():
    mesh = scrambled(grid(3), 0.15, 1)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    x, count = energy.to_edge_units(mesh.points), mesh.n_hexes
    jacobians, none = jacobians_of(x, mesh.hexes).min(axis=1), np.full(count, -np.inf)
    qualities = qualities_of(x, mesh.hexes, energy.omitted)
    free = np.zeros(count, np.uint8)
    above, below = (jacobians, none), (none, qualities)
    for shift, finite in ((1e-9, False), (-1e-3, True)):
        for low in (above, below):
            floors = [values + shift for values in low]
            values = energy.with_barrier(FloorBarrier(*floors, free, 0.1, 0.1, 1.0)).barriers(x)
            assert np.isfinite(values).all() == finite
            assert (values > 0).all()
    barrier = FloorBarrier(jacobians - 0.2, qualities - 0.2, free, 0.199, 0.199, 1.0)
    assert (energy.with_barrier(barrier).barriers(x) == 0).all()
    np.testing.assert_array_equal(energy.with_barrier(barrier).gradient(x), energy.gradient(x))
    worst = int(jacobians.argmin())
    low = none.copy()
    low[worst] = jacobians[worst] + 1e-9
    barrier = FloorBarrier(low, none, free, 0.1, 0.1, 1.0)
    assert energy.with_barrier(barrier).value(x) == np.inf
    ignored = free.copy()
    ignored[worst] = 255
    assert np.isfinite(energy.with_barrier(FloorBarrier(low, none, ignored, 0.1, 0.1, 1.0)).value(x))


def test_a_flattened_and_an_inverted_hex_are_below_any_floor():
    mesh = grid(2)
    points = mesh.points.copy()
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0), np.full(mesh.n_hexes, 255, np.uint8))
    floors, none = np.full(8, -0.1), np.full(8, -np.inf)
    barrier = energy.with_barrier(FloorBarrier(floors, none, np.zeros(8, np.uint8), 0.1, 0.1, 1.0))
    assert (barrier.barriers(points) == 0).all()
    (inner,) = np.flatnonzero(mesh.free)
    points[inner] = [1, 1, 0]  # where a neighbour is: an edge of no length
    assert np.isinf(barrier.barriers(points)).any()
    points[inner] = [5, 5, 5]
    assert np.isinf(barrier.barriers(points)).any()
