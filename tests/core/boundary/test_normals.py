"""Directions of triangles and curves."""

import numpy as np
import pytest

from hexmend.boundary.classification import NodeClass, boundary_of
from hexmend.boundary.normals import curve_tangents, segment_tangents, unit_vectors
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


def test_unit_vectors_have_length_1_or_are_0():
    np.testing.assert_array_equal(unit_vectors(np.array([[0.0, 0, 0], [0, -2, 0]])), [[0, 0, 0], [0, -1, 0]])
