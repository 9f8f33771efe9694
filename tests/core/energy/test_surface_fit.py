"""Fit of a moving boundary to its surface: derivatives, distances, and parts."""

import numpy as np
import pytest

from tests.core.boundary.solids import ball, cylinder
from tests.core.energy.fits import fit_of, moved, on_top
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
