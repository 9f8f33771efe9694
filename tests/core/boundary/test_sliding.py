"""Sliding nodes of a boundary, their neighbours and their projection."""

import numpy as np

from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.gallery import make
from tests.core.boundary.solids import ball


def test_rings_of_sliding_nodes_are_on_their_own_curves_and_patches():
    mesh = make("bridge-sharp", size=500)
    sliding = SlidingBoundary(mesh)
    kind, part, rings = sliding.boundary.node_class, sliding.boundary.component, sliding.rings
    for node in range(mesh.n_nodes):
        whole, ring = mesh.topology.rings[node], rings[node]
        assert set(ring) <= set(whole)
        if kind[node] < NodeClass.CURVE:
            np.testing.assert_array_equal(ring, whole)
        elif kind[node] == NodeClass.CURVE:
            assert len(ring) == 2
            assert all(part[other] == part[node] or kind[other] == NodeClass.CORNER for other in ring)
        else:
            assert len(ring) >= 3
            assert all(kind[other] != NodeClass.INSIDE for other in ring)


def test_a_mesh_keeps_its_surface_on_request():
    mesh = ball(3)
    moved = mesh.keeping_surface().with_points(1.1 * mesh.points)
    np.testing.assert_array_equal(moved.surface_points, mesh.points)
    np.testing.assert_array_equal(moved.keeping_surface().with_points(mesh.points).surface_points, mesh.points)
    np.testing.assert_array_equal(mesh.with_points(1.1 * mesh.points).surface_points, 1.1 * mesh.points)
    np.testing.assert_array_equal(SlidingBoundary(moved).mesh.points, moved.points)
    places = SlidingBoundary(moved).project(moved.points[SlidingBoundary(moved).nodes])
    np.testing.assert_allclose(np.linalg.norm(places, axis=1), 1, atol=0.2)
