"""The kernels number the reference hexahedron as `hexmend.mesh.hexahedron` does."""

import numpy as np
import pytest

from hexmend.mesh import hexahedron
from tests.core.native.extension import extension

native = extension().hexahedron


@pytest.mark.parametrize("table", ["CORNER_TETRAHEDRA", "EDGES", "DIAGONALS", "FACES", "UNIT_CUBE"])
def test_a_table_is_the_same_in_both_languages(table):
    np.testing.assert_array_equal(getattr(native, table), getattr(hexahedron, table))


def test_the_faces_at_a_corner_turn_their_triangle_outwards():
    centres = hexahedron.UNIT_CUBE[hexahedron.FACES].mean(axis=1)
    for corner, faces in zip(hexahedron.UNIT_CUBE, native.CORNER_FACES, strict=True):
        a, b, c = centres[list(faces)]
        towards = 2 * corner - 1
        np.testing.assert_array_equal(np.cross(b - a, c - a), 0.25 * towards)


def test_a_rotated_hex_is_the_same_hex():
    for corner, rotated in enumerate(native.ROTATIONS):
        assert rotated[0] == corner
        x, there = hexahedron.UNIT_CUBE[list(rotated)], hexahedron.UNIT_CUBE
        distances = [np.linalg.norm(places[:, None] - places, axis=-1) for places in (x, there)]
        np.testing.assert_array_equal(*distances)
        assert np.linalg.det(x[[1, 3, 4]] - x[0]) == 1  # rotated, not mirrored
