"""Boundaries of second-order hexes slide on their curved faces."""

import numpy as np
import pytest

from hexmend import Mesh, smooth
from hexmend.boundary import boundary_of
from hexmend.boundary.sliding.curved_faces import surface_of_boundary
from hexmend.mesh.second_order import MID_EDGES
from tests.core.boundary.solids import ball
from tests.core.grids import grid


def with_mid_nodes(mesh, on_sphere):
    """Give all edges a mid-node, those of the boundary on the unit sphere if asked for."""
    edges, place = np.unique(np.sort(mesh.hexes[:, MID_EDGES].reshape(-1, 2)), axis=0, return_inverse=True)
    mids = np.full((mesh.n_hexes, 19), -1)
    mids[:, :12] = mesh.n_nodes + place.reshape(-1, 12)
    middles = mesh.points[edges].mean(axis=1)
    if on_sphere:
        outer = mesh.topology.boundary[edges].all(axis=1)
        middles[outer] /= np.linalg.norm(middles[outer], axis=1, keepdims=True)
    return Mesh(np.vstack([mesh.points, middles]), mesh.hexes, mid_nodes=mids)


@pytest.mark.parametrize("method", [pytest.param("mend", marks=pytest.mark.slow), "local-sd"])
def test_corners_of_a_second_order_ball_slide_on_the_sphere_and_not_on_its_chords(method):
    """Other goals of mend let them leave it within a tolerance."""
    mesh = with_mid_nodes(ball(6), True)
    goal = {"goal": "shape"} if method == "mend" else {}
    result = smooth(mesh, method, boundary="slide", keep_last=True, **goal).mesh
    corners = mesh.topology.boundary & mesh.topology.used
    assert np.linalg.norm(result.points - mesh.points, axis=1)[corners].max() > 0.01
    np.testing.assert_allclose(np.linalg.norm(result.points[corners], axis=1), 1, atol=1e-3)


def test_points_of_curved_edges_and_faces_lie_on_their_curves_and_patches():
    mesh = with_mid_nodes(grid(2), False)
    bulge = 0.2 * mesh.points[:, :1] * (2 - mesh.points[:, :1])  # a parabola over both hexes, quadratic on each
    mesh = Mesh(mesh.points + bulge * [0, 0, 1], mesh.hexes, mid_nodes=mesh.mid_nodes)
    boundary = boundary_of(mesh)
    surface = surface_of_boundary(mesh, mesh.points, boundary)
    assert (surface.n_patches, surface.n_curves) == (boundary.n_patches, boundary.n_curves) == (6, 12)
    np.testing.assert_array_equal(surface.node_class, boundary.node_class)
    x = np.linspace(0, 2, 33)
    for y, counts in (0.0, (2, 1)), (0.7, (1, 0)):  # on an edge, and within the top
        places = np.column_stack([x, np.full(33, y), 2 + 0.2 * x * (2 - x)])
        found = [surface.trees.closest(places, np.full(33, k)).points for k in range(18)]
        near = np.array([np.linalg.norm(one - places, axis=1).max() for one in found]) < 1e-3
        assert (np.count_nonzero(near[:6]), np.count_nonzero(near[6:])) == counts
