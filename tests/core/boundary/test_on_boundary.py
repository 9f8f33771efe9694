"""Sliding nodes among those of the boundary alone do as those of the whole mesh do."""

import numpy as np
import pytest

from hexmend.boundary import SkinSurface, SlidingBoundary
from hexmend.gallery import make


def on_itself():
    mesh = make("five-side", size=400, scramble=0.1)
    return SlidingBoundary(mesh, max_deviation=0.01 * mesh.mean_edge_length)


def on_a_target():
    """The boundary of a coarse mesh on that of a finer one."""
    mesh, fine = make("five-side", size=400, scramble=0.1), make("five-side", size=3000)
    skin = SkinSurface(fine.points, fine.topology.boundary_faces)
    return SlidingBoundary(mesh.sliding_on(skin), max_deviation=0.01 * mesh.mean_edge_length)


@pytest.fixture(scope="module", params=[on_itself, on_a_target])
def sliding(request):
    return request.param()


def test_places_directions_and_rejected_nodes_are_the_same(sliding):
    alone, numbers = sliding.on_boundary()
    points = sliding.mesh.points
    np.testing.assert_array_equal(alone.points, points[numbers])
    np.testing.assert_array_equal(numbers[alone.nodes], sliding.nodes)
    rng = np.random.default_rng(1)
    moved = points + 0.4 * sliding.mesh.mean_edge_length * rng.standard_normal(points.shape)
    moved[sliding.nodes] = places = sliding.project(moved[sliding.nodes])
    np.testing.assert_allclose(alone.project(moved[numbers][alone.nodes]), places, atol=1e-14)
    np.testing.assert_allclose(alone.tangent_bases(places), sliding.tangent_bases(places), atol=1e-9)
    rejected = sliding.rejected_nodes(points, moved)
    assert rejected.size
    np.testing.assert_array_equal(numbers[alone.rejected_nodes(points[numbers], moved[numbers])], rejected)
