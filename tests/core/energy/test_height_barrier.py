"""Barrier of heights: derivatives, infinite at the floor, zero above its band, semidefinite."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.optimise.floors.movable_hexes import MovableHeights
from tests.core.grids import grid, scrambled


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
