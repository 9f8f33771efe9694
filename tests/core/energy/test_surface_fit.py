"""Fit of a moving boundary to its surface: derivatives, distances, and parts.

Limits of a moving boundary: tolerances of its fit to the surface, steps through them, and room.
"""

import numpy as np
import pytest

from tests.core.boundary.solids import ball, cylinder
from tests.core.energy.fits import TOLERANCE, fit_of, moved, on_top
from tests.core.grids import grid

SOLIDS = {"ball": lambda: ball(3), "cylinder": lambda: cylinder(16, 2)}
COSTS = {"barrier": {"weight": 2.0}, "ceiling": {"slope": 3.0}}
costs = pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)


@pytest.fixture(scope="module", params=SOLIDS)
def curved(request):
    """A solid whose nodes are a little off the surface."""
    fit, energy, x = fit_of(SOLIDS[request.param]())
    return fit, energy, x + np.random.default_rng(1).uniform(-0.05, 0.05, x.shape)


@costs
def test_the_gradient_is_that_of_differences(curved, cost):
    fit, _, x = curved
    fit = fit.with_weights(**cost)
    way = np.random.default_rng(0).normal(size=x.shape)
    slope = (fit.value(x + 1e-6 * way) - fit.value(x - 1e-6 * way)) / 2e-6
    assert (fit.gradient(x) * way).sum() == pytest.approx(slope, rel=1e-6)
    assert fit.value(x) > 1e-2


@costs
def test_the_matrix_is_symmetric_and_semidefinite(curved, cost):
    fit, energy, x = curved
    own = energy.with_surface(fit.with_weights(**cost)).hessian(x, 1.0).assembled(np.float64)
    without = energy.with_surface(fit.with_weights()).hessian(x, 1.0).assembled(np.float64)
    added = np.stack([own @ row - without @ row for row in np.eye(3 * len(x))])
    np.testing.assert_allclose(added, added.T, atol=1e-9 * np.abs(added).max())
    assert np.linalg.eigvalsh(added).min() > -1e-9 * np.abs(added).max()


@costs
@pytest.mark.parametrize("height", [0.0, 0.05, 0.15])
def test_the_curvature_along_normals_of_a_plane_is_that_of_differences(cost, height):
    fit, energy, x = fit_of(grid(4))
    fit = fit.with_weights(**cost)
    way = np.where(on_top(x)[:, None], [0.0, 0.0, 1.0], 0.0)
    own, without = (energy.with_surface(f).hessian(x + height * way, 1.0) for f in (fit, fit.with_weights()))
    v = way[energy.nodes].ravel()
    rise = ((fit.gradient(x + (height + h) * way) * way).sum() for h in (1e-6, -1e-6))
    assert v @ (own @ v - without @ v) == pytest.approx((next(rise) - next(rise)) / 2e-6, rel=2e-5)


def test_distances_are_those_along_the_normal():
    fit, _, x = fit_of(grid(4))
    node = int(np.flatnonzero(on_top(x) & (x[:, :2] == 2).all(axis=1))[0])
    np.testing.assert_array_equal(fit.distances(x), 0.0)
    far = fit.distances(moved(x, on_top(x), [0, 0, 0.125]))
    assert set(np.round(far, 12)) == {0.0, 0.125}
    h = 0.1
    far = fit.distances(moved(x, node, [0, 0, h]))
    own = far[: (len(far) + fit.diagonal.sum()) // 2]
    np.testing.assert_allclose(np.sort(own)[-14:], [0, *4 * [h / 4], *8 * [h / 2], h], atol=1e-12)
    assert far[len(own) :].max() == pytest.approx(h / np.sqrt(1 + 1.25 * h * h), rel=1e-9)  # of the tilted triangles


@costs
def test_a_part_has_the_gradient_and_the_change_of_the_whole(curved, cost):
    fit, energy, x = curved
    fit, mesh = fit.with_weights(**cost), energy.mesh
    moving = np.arange(3)
    nodes = np.unique(mesh.hexes[np.isin(mesh.hexes, moving).any(axis=1)])
    inside = np.isin(nodes, moving)
    part = fit.on_part(nodes, inside, x)
    there = moved(x, moving, np.random.default_rng(3).uniform(-0.02, 0.02, (3, 3)))
    np.testing.assert_allclose(part.gradient(there[nodes])[inside], fit.gradient(there)[moving], atol=1e-9)
    change = part.value(there[nodes]) - part.value(x[nodes])
    assert change == pytest.approx(fit.value(there) - fit.value(x), abs=1e-9)


@pytest.fixture(scope="module")
def block():
    """A block with the number of a node in the middle of its top."""
    fit, energy, x = fit_of(grid(4))
    return fit, energy, x, int(np.flatnonzero(on_top(x) & (x[:, :2] == 2).all(axis=1))[0])


def test_a_barrier_is_infinite_beyond_a_tolerance_and_a_ceiling_is_not(block):
    fit, _, x, node = block
    for height in (1.001 * TOLERANCE, 3 * TOLERANCE):
        there = moved(x, node, [0, 0, height])
        assert fit.with_weights(weight=1.0).value(there) == np.inf
        assert np.isfinite(fit.with_weights(slope=1.0).value(there))
    assert np.isfinite(fit.with_weights(weight=1.0).value(moved(x, node, [0, 0, 0.999 * TOLERANCE])))
    assert fit.with_weights(weight=1.0, slope=1.0).value(x) == pytest.approx(0, abs=1e-12)


def test_steps_through_the_tolerance_are_marked(block):
    fit, energy, x, node = block
    fit = fit.with_weights(weight=1.0)
    marks = fit.beyond(x, moved(x, node, [0, 0, 1.5 * TOLERANCE]))
    np.testing.assert_array_equal(np.flatnonzero(marks), node)
    np.testing.assert_array_equal(energy.with_surface(fit).infeasible_nodes(x, moved(x, node, [0, 0, 0.3])), marks)
    assert fit.beyond(x, moved(x, node, [0, 0, 0.5 * TOLERANCE])) is None
    assert fit.beyond(x, moved(x, node, [0.4, 0.3, 0])) is None
    assert fit.with_weights(slope=1.0).beyond(x, moved(x, node, [0, 0, 1.5 * TOLERANCE])) is None


def test_room_is_made_for_positions_outside(block):
    fit, _, x, node = block
    for height in (1.1, 1.5, 3):
        there = moved(x, node, [0, 0, height * TOLERANCE])
        assert not fit.is_within(there)
        wider = fit.with_weights(weight=1.0).allowing(there, np.full_like(fit.diagonal, True))
        assert wider.is_within(there, 1 + 1e-12)
        assert np.isfinite(wider.value(there))
        assert (wider.tolerances >= fit.tolerances).all()
        same = fit.allowing(there, np.full_like(fit.diagonal, False))
        np.testing.assert_array_equal(same.tolerances, fit.tolerances)


def test_within_is_allowing_to_the_tolerance_or_a_multiple_of_it(block):
    fit, _, x, node = block
    assert fit.is_within(moved(x, node, [0, 0, 0.94 * TOLERANCE]))
    assert not fit.is_within(moved(x, node, [0, 0, 0.96 * TOLERANCE]))
    assert fit.is_within(moved(x, node, [0, 0, 1.8 * TOLERANCE]), 2.0)
    assert not fit.is_within(moved(x, node, [0, 0, 2.0 * TOLERANCE]), 2.0)
