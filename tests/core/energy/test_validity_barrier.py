"""Barrier of the Bernstein coefficients of det J: its gradient by differences, its floors, and what these certify.

Barrier of heights: derivatives, infinite at the floor, zero above its band, semidefinite.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.barriers.validity_barrier import ValidityBarrier
from hexmend.optimise.floors.movable_hexes import MovableHeights
from hexmend.quality.validity import Validity, certify
from tests.core.grids import grid, scrambled
from tests.core.solid_lattices import mixed

NORM = ObjectiveNorm()
seeds = st.integers(0, 2**32 - 1)


def case_of(seed, amplitude=0.4):
    """A barrier of some cells of a grid, or of a mesh of all kinds, with values in its band, and positions."""
    mesh = scrambled(mixed(3) if seed % 2 else grid(3), amplitude, seed)
    return ValidityBarrier.of(mesh.elements[::4].copy(), mesh.points, 0.1, 1.0), mesh.points


@given(seeds)
def test_its_gradient_is_that_of_differences(seed):
    barrier, x = case_of(seed)
    way = np.random.default_rng(seed).normal(size=x.shape)
    step = 1e-6
    rise = (barrier.value(x + step * way, NORM) - barrier.value(x - step * way, NORM)) / (2 * step)
    gradient = barrier.gradient(x, NORM)
    scale = np.abs(gradient * way).sum()
    assert np.isfinite(rise)
    assert (gradient * way).sum() == pytest.approx(rise, abs=1e-5 * max(scale, 1))


@given(seeds, st.floats(0.01, 0.9))
def test_floors_never_fall_and_stay_below_the_coefficients(seed, gap):
    barrier, x = case_of(seed)
    for _ in range(3):
        higher = barrier.with_higher_floors(x, gap)
        assert (higher.floors >= barrier.floors).all()
        assert higher.deficit <= barrier.deficit
        assert np.isfinite(higher.value(x, NORM))
        barrier, x = higher, x + np.random.default_rng(seed).uniform(-1e-3, 1e-3, x.shape)
        if not np.isfinite(barrier.value(x, NORM)):
            return


@given(seeds)
def test_hexes_are_valid_where_the_barrier_is_finite_over_floors_that_are_not_negative(seed):
    barrier, x = case_of(seed, 0.25)
    barrier = barrier.with_higher_floors(x, 0.25)
    valid = certify(x, barrier.hexes) == Validity.VALID
    assert valid[barrier.floors >= 0].all()
    assert (barrier.floors >= 0).any()


@pytest.fixture
def case():
    mesh = scrambled(grid(3), 0.2, 2)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    x = energy.to_edge_units(mesh.points)
    return energy, MovableHeights(energy, 0.5), x


def test_derivatives_are_those_of_differences(case):
    energy, heights, x = case
    least = heights.corners(x).min()
    raised = energy.with_barrier(heights.barrier(least - 0.05, -np.inf, 0.6, 0.6, 3.0))
    way = np.random.default_rng(0).normal(size=(energy.nodes.size, 3))
    there, back = raised.moved(x, way, 1e-6), raised.moved(x, way, -1e-6)
    slope = (raised.value(there) - raised.value(back)) / 2e-6
    assert (raised.gradient(x) * way).sum() == pytest.approx(slope, rel=1e-6)
    assert raised.value(x) > energy.value(x) + 1


def test_the_matrix_is_that_of_the_hexes_and_a_semidefinite_one(case):
    energy, heights, x = case
    least = heights.corners(x).min()
    raised = energy.with_barrier(heights.barrier(least - 0.05, -np.inf, 0.6, 0.6, 3.0))
    own, size = raised.hessian(x).assembled(np.float64), 3 * energy.nodes.size
    without = energy.with_barrier(heights.barrier(least - 5, -np.inf, 0.6, 0.6, 3.0)).hessian(x).assembled(np.float64)
    added = np.stack([own @ row - without @ row for row in np.eye(size)])
    np.testing.assert_allclose(added, added.T, atol=1e-9)
    assert np.linalg.eigvalsh(added).min() > -1e-9
    assert np.abs(added).max() > 1


def test_it_is_infinite_at_the_floor_and_zero_above_its_band(case):
    energy, heights, x = case
    least = heights.corners(x).min()
    assert energy.with_barrier(heights.barrier(least, -np.inf, 0.1, 0.1, 1.0)).value(x) == np.inf
    assert energy.with_barrier(heights.barrier(least - 0.2, -np.inf, 0.1, 0.1, 1.0)).value(x) == energy.value(x)
