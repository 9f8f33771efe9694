"""Closest points of a surface of quads or triangles, by nodes and weights."""

import numpy as np
import pytest

from hexmend.boundary.skin_surface import SkinSurface
from tests.core.grids import grid


@pytest.fixture(params=["quads", "triangles"])
def skin(request):
    mesh = grid(2)
    faces = mesh.topology.boundary_faces
    if request.param == "triangles":
        faces = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    return SkinSurface(mesh.points, np.ascontiguousarray(faces))


def test_the_closest_point_is_a_weighted_mean_of_the_nodes_of_one_face(skin):
    x = np.random.default_rng(5).uniform(-1, 3, (40, 3))
    found = skin.find(x)
    places, (nodes, weights) = found.points, skin.weights_of_nodes(found)
    np.testing.assert_array_equal(places, skin.closest(x))
    np.testing.assert_allclose(np.einsum("kn,kni->ki", weights, skin.points[nodes]), places, atol=1e-12)
    np.testing.assert_allclose(weights.sum(axis=1), 1)
    assert weights.min() >= -1e-12
    faces = {tuple(sorted(face)) for face in skin.faces.tolist()}
    assert all(tuple(sorted(row)) in faces for row in nodes.tolist())


def test_samples_are_nodes_then_midpoints_of_edges_and_faces_on_the_surface(skin):
    samples = skin.samples()
    n, e = len(skin.nodes), len(skin.edges.nodes)
    assert len(samples) == n + e + len(skin.faces)
    np.testing.assert_array_equal(samples[:n], skin.points[skin.nodes])
    np.testing.assert_allclose(samples[n : n + e], skin.points[skin.edges.nodes].mean(axis=1))
    np.testing.assert_allclose(samples[n + e :], skin.points[skin.faces].mean(axis=1))
    np.testing.assert_allclose(skin.distances(samples), 0, atol=1e-12)


def test_samples_at_a_spacing_leave_out_midpoints_of_shorter_edges_and_of_faces_without_a_longer_one():
    x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [9, 1, 0]], dtype=float)
    skin = SkinSurface(x, np.array([[0, 1, 2], [0, 2, 3], [1, 4, 2]], dtype=np.int32))
    middles = [[5, 0.5, 0], [5, 1, 0]], [[11 / 3, 2 / 3, 0]]
    np.testing.assert_allclose(skin.samples(2.0), np.concatenate([x, *middles]))
    np.testing.assert_array_equal(skin.samples(20.0), x)
    np.testing.assert_allclose(
        skin.with_points(x / 4).samples(2.0), np.concatenate([x, middles[0][:1], middles[1]]) / 4
    )
