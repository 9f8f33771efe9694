"""Consistency of the tables of the reference hexahedron."""

import numpy as np

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, EDGES, FACES, UNIT_CUBE, VOXEL_ORDER


def test_corner_tetrahedra_have_unit_determinant_on_the_cube():
    x = UNIT_CUBE[CORNER_TETRAHEDRA]
    np.testing.assert_allclose(np.linalg.det(x[:, 1:] - x[:, :1]), 1, atol=1e-15)


def test_each_corner_is_apex_once_and_neighbours_are_edges():
    assert sorted(CORNER_TETRAHEDRA[:, 0]) == list(range(8))
    edges = {frozenset(edge) for edge in EDGES.tolist()}
    assert len(edges) == 12
    for apex, *others in CORNER_TETRAHEDRA.tolist():
        assert all(frozenset((apex, other)) in edges for other in others)


def test_edges_have_length_one_on_the_cube():
    np.testing.assert_array_equal(np.linalg.norm(UNIT_CUBE[EDGES[:, 0]] - UNIT_CUBE[EDGES[:, 1]], axis=1), 1)


def test_faces_are_counter_clockwise_from_outside():
    for face in UNIT_CUBE[FACES]:
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        assert normal @ (face.mean(axis=0) - 0.5) > 0


def test_voxel_order_turns_a_voxel_into_a_hexahedron():
    voxel = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    np.testing.assert_array_equal(voxel[VOXEL_ORDER], UNIT_CUBE)
