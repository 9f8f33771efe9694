"""The least as an eliminated unknown: the floor itself, derivatives, the corrected direction, and multipliers."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.optimise.floors.maximised_floor import FloorDirection, MaximisedFloor, Reward
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from tests.core.grids import grid, scrambled

REWARD = Reward(100.0, 2.0, 0.2, 0.3)
FINE = TruncatedNewtonConfig(2000, loosest=1e-10, tightest=1e-11)


@pytest.fixture(scope="module")
def case():
    """The energy of a grid that is not quite a lattice, the same with the maximised least, and positions."""
    mesh = scrambled(grid(3), 0.1, 4)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    return energy, MaximisedFloor(energy, REWARD, MovableHexes(energy)), energy.to_edge_units(mesh.points)


def with_floor(energy, t):
    """The energy with the barriers of a floor t."""
    weight = REWARD.weight
    return energy.with_barrier(MovableHexes(energy).barrier(t, REWARD.quality_floor, REWARD.band, REWARD.band, weight))


def test_floor_and_value_are_those_of_the_minimum_by_the_floor(case):
    plain, maximised, x = case
    for at in (x, plain.moved(x, np.random.default_rng(0).normal(size=(plain.nodes.size, 3)), 0.02)):
        least = MovableHexes(plain).corners(at).min()
        found = minimize_scalar(
            lambda t, at=at: with_floor(plain, t).value(at) - REWARD.reward * t,
            bounds=(least - 0.2, least - 1e-9),
            method="bounded",
            options={"xatol": 1e-10},
        )
        assert maximised.floor(at).t == pytest.approx(found.x, abs=1e-6)
        assert maximised.value(at) == pytest.approx(found.fun, rel=1e-9)


def test_the_gap_is_that_of_the_reward_if_one_corner_alone_is_near(case):
    plain, _, x = case
    least, second = np.sort(MovableHexes(plain).corners(x))[:2]
    reward = Reward(100.0, 0.1 * (second - least), (second - least) / 2)
    floor = MaximisedFloor(plain, reward, MovableHexes(plain)).floor(x)
    assert least - floor.t == pytest.approx(reward.gap, rel=0.01)


def test_gradient_and_mixed_derivative_are_those_of_differences(case):
    plain, maximised, x = case
    h, step = 1e-6, np.random.default_rng(1).normal(size=(plain.nodes.size, 3))
    there, back = plain.moved(x, step, h), plain.moved(x, step, -h)
    by_differences = (maximised.value(there) - maximised.value(back)) / (2 * h)
    assert (maximised.gradient(x) * step).sum() == pytest.approx(by_differences, rel=1e-6)
    along = (maximised.floor(there).t - maximised.floor(back).t) / (2 * h)  # dt = -b dx/c
    assert -(maximised.mixed(x) * step).sum() / maximised.floor(x).curvature == pytest.approx(along, rel=1e-4)


def test_the_curvature_is_that_of_differences(case):
    plain, maximised, x = case
    floor, h = maximised.floor(x), 1e-5
    values = [with_floor(plain, floor.t + k * h).value(x) for k in (-1, 0, 1)]
    assert floor.curvature == pytest.approx((values[0] - 2 * values[1] + values[2]) / h**2, rel=1e-3)


def test_the_direction_is_that_of_the_bordered_system(case):
    _, maximised, x = case
    gradient, hessian, b = maximised.gradient(x), maximised.hessian(x), maximised.mixed(x).ravel()
    matrix = hessian.assembled(np.float64)
    dense = np.stack([matrix @ row for row in np.eye(b.size)])
    bordered = np.block([[dense, b[:, None]], [b[None], np.array([[maximised.floor(x).curvature]])]])
    expected = np.linalg.solve(bordered, -np.append(gradient.ravel(), 0.0))[:-1]
    found = FloorDirection(maximised, TruncatedNewton(FINE))(maximised.value(x), gradient, hessian).vector
    assert np.linalg.eigvalsh(dense).min() > 0
    np.testing.assert_allclose(found.ravel(), expected, atol=1e-5 * np.abs(expected).max())
    uncorrected = np.linalg.solve(dense, -gradient.ravel())
    assert np.abs(uncorrected - expected).max() > 0.1 * np.abs(expected).max()


def test_multipliers_sum_to_1_at_corners_near_the_floor(case):
    plain, maximised, x = case
    hexes, nodes, shares = maximised.multipliers(x)
    assert shares.sum() == pytest.approx(1, abs=1e-9)
    assert (shares > 0).all()
    heavy = np.argmax(shares)
    corners = MovableHexes(plain).corners_in_place(x)
    at = np.unravel_index(np.argmin(corners), corners.shape)
    assert (hexes[heavy], nodes[heavy]) == (at[0], plain.mesh.hexes[at])
