"""Hexes that share a face are numbered alike if they traverse it in opposite directions."""

import numpy as np
import pytest

from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes, with_consistent_orientation
from hexmend.mesh.topology.face_parity import face_parity
from tests.core.doctor.faulty_meshes import found_in
from tests.core.grids import grid

#: Corners of the last cross-section of a ring that meet those of the first, and whether a numbering exists.
CLOSINGS = {"straight": ([0, 1, 2, 3], 1), "half a turn": ([2, 3, 0, 1], 1), "reflected": ([1, 0, 3, 2], 0)}


def ring(closing, count=6):
    """Make a ring of hexes around the z axis, whose last cross-section is joined to the first by a permutation."""
    angle = 2 * np.pi * np.arange(count) / count
    radius, height = np.array([2, 3, 3, 2]), np.array([0, 0, 1, 1])
    points = np.stack(
        [np.outer(np.cos(angle), radius), np.outer(np.sin(angle), radius), np.tile(height, (count, 1))], 2
    )
    sections = np.arange(4 * count).reshape(count, 4)
    ahead = np.concatenate([sections[1:], sections[:1, closing]])
    return Mesh(points.reshape(-1, 3), np.concatenate([sections, ahead], axis=1)[:, MIRRORED_CORNERS])


def parity(mesh):
    return face_parity(mesh.hexes, mesh.topology.neighbours_in_any_order)


@pytest.mark.parametrize("closing", CLOSINGS)
def test_only_a_ring_closed_by_a_reflection_has_no_numbering_and_the_doctor_says_so(closing):
    corners, orientable = CLOSINGS[closing]
    mesh = ring(corners)
    assert parity(mesh)[1].tolist() == [orientable] * mesh.n_hexes
    found = found_in(mesh)
    assert ("contradictory-faces" in found) is not orientable
    if not orientable:
        assert found["contradictory-faces"].count == mesh.n_hexes
        assert not found["contradictory-faces"].mendable


def test_where_the_faces_contradict_each_other_no_hex_is_renumbered():
    mesh = ring(CLOSINGS["reflected"][0])
    hexes = mesh.hexes.copy()
    hexes[2] = hexes[2][MIRRORED_CORNERS]
    mesh = mesh.rebuilt(hexes=hexes)
    assert not left_handed_hexes(mesh).any()
    assert with_consistent_orientation(mesh) is mesh


@pytest.mark.parametrize("seed", range(3))
def test_signs_do_not_depend_on_which_corner_is_numbered_first(seed):
    random, mesh = np.random.default_rng(seed), grid(3)
    quarter_turn, tilt = [1, 2, 3, 0, 5, 6, 7, 4], [3, 2, 6, 7, 0, 1, 5, 4]
    hexes, wrong = mesh.hexes.copy(), random.random(27) < 0.4
    for h in range(27):
        for turn in (quarter_turn, tilt) * random.integers(1, 4):
            hexes[h] = hexes[h][turn] if random.random() < 0.5 else hexes[h]
    hexes[wrong] = hexes[wrong][:, MIRRORED_CORNERS]
    component, sign = parity(Mesh(mesh.points, hexes))
    assert set(component) == {0}
    np.testing.assert_array_equal(sign * sign[0], np.where(wrong, -1, 1) * (-1 if wrong[0] else 1))


def test_a_voxel_and_a_hexahedron_with_the_nodes_of_one_face_are_not_compared():
    mesh = grid(1, 1, 2)
    hexes = mesh.hexes.copy()
    hexes[1] = hexes[1][VOXEL_ORDER]
    mixed = Mesh(mesh.points, hexes)
    assert (mixed.topology.neighbours_in_any_order >= 0).sum() == 2
    assert parity(mixed)[0].tolist() == [0, 1]
    assert parity(Mesh(mesh.points, mesh.hexes[:, VOXEL_ORDER]))[0].tolist() == [0, 0]


def test_faces_of_more_than_two_hexes_compare_none():
    hexes = grid(1, 1, 2).hexes
    crowded = np.concatenate([hexes, hexes[1:] + 4])
    crowded[2, :4] = hexes[0, 4:]
    points = np.concatenate([grid(1, 1, 2).points, grid(1).points[4:] + [3, 0, 0]])
    component, sign = parity(Mesh(points, crowded))
    assert sorted(component) == [0, 1, 2]
    assert sign.tolist() == [1, 1, 1]
