"""Directions of triangles and curves."""

import numpy as np
import pytest

from hexmend.boundary.classification import NodeClass, boundary_of
from hexmend.boundary.normals import curve_tangents, directions_of_means, segment_tangents, unit_vectors, vertex_normals
from tests.core.boundary.solids import cylinder


@pytest.fixture(scope="module")
def rims():
    """A cylinder, whose two rims are curves without corners."""
    mesh = cylinder()
    return mesh, boundary_of(mesh)


def test_tangents_of_curves_are_unit_vectors_in_the_sense_of_their_segments(rims):
    mesh, boundary = rims
    tangents, own = curve_tangents(mesh.points, boundary), segment_tangents(mesh.points, boundary.segments)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=2), 1)
    assert (np.einsum("sei,si->se", tangents, own) > 0.9).all()


def test_the_tangents_of_a_circle_stand_at_right_angles_to_its_radius(rims):
    mesh, boundary = rims
    assert (boundary.node_class[boundary.segments] == NodeClass.CURVE).all()
    out = mesh.points[boundary.segments] * [1, 1, 0]
    np.testing.assert_allclose(np.einsum("sei,sei->se", curve_tangents(mesh.points, boundary), out), 0, atol=1e-12)


def weighted_by_angles(vertices, triangles, patch):
    """The definition: at each corner the mean of the normals of the triangles of its patch, weighted by their angles."""
    normals = np.zeros((len(triangles), 3, 3))
    for own, corner in np.ndindex(len(triangles), 3):
        for other, triangle in enumerate(triangles):
            for at in np.flatnonzero(triangle == triangles[own, corner]):
                one, two = (vertices[triangle[(at + k) % 3]] - vertices[triangle[at]] for k in (1, 2))
                across = np.cross(one, two)
                size = np.linalg.norm(across)
                if patch[other] == patch[own] and size > 0:
                    normals[own, corner] += np.arctan2(size, one @ two) * across / size
    return unit_vectors(normals)


@pytest.mark.parametrize("patches", [1, 2, 20])
def test_normals_of_vertices_are_means_weighted_by_angles_over_their_own_patch(patches):
    random = np.random.default_rng(patches)
    vertices, triangles = random.normal(size=(12, 3)), random.integers(0, 12, (40, 3)).astype(np.int32)
    patch = random.integers(0, patches, 40)
    expected = weighted_by_angles(vertices, triangles, patch)
    np.testing.assert_allclose(vertex_normals(vertices, triangles, patch), expected, atol=1e-9)
    assert (np.diff(np.sort(triangles), axis=1) == 0).any()  # some have no area


def test_means_of_opposed_vectors_have_the_direction_that_is_given_for_them():
    means, otherwise = np.array([[0, 0, 0.5], [0, 0, 1e-16]]), np.array([[1.0, 0, 0], [0, 1.0, 0]])
    np.testing.assert_array_equal(directions_of_means(means, otherwise), [[0, 0, 1], [0, 1, 0]])
