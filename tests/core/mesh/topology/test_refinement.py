"""Recognition of uniform refinements, and interpolation from the coarse mesh."""

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes, with_consistent_orientation
from hexmend.mesh.topology.face_parity import face_parity
from hexmend.smoothers.mend.nested.nested_start import find_refinement
from tests.core.doctor.faulty_meshes import found_in
from tests.core.grids import grid
from tests.core.refined_meshes import refined, renumbered

COARSE = {
    "one hex": lambda: grid(1),
    "odd counts": lambda: grid(3, 1, 5),
    "five-side": lambda: make("five-side", size=40),
    "bridge-sharp": lambda: make("bridge-sharp", size=200),
    "two components": lambda: two(grid(2), grid(1)),
    "ring": lambda: ring(3),
}


def two(one, other):
    return Mesh(
        np.concatenate([one.points, other.points + 100.0]), np.concatenate([one.hexes, other.hexes + one.n_nodes])
    )


def ring(n):
    """n hexes around an axis: no node has an odd number of hexes."""
    whole = grid(n, 1, 1)
    angle, radius = whole.points[:, 0] * 2 * np.pi / n, 2 + whole.points[:, 1]
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), whole.points[:, 2]])
    last, first = (np.flatnonzero(whole.points[:, 0] == end) for end in (n, 0))
    number = np.arange(whole.n_nodes)
    number[last] = first
    used, hexes = np.unique(number[whole.hexes], return_inverse=True)
    return Mesh(points[used], hexes.reshape(-1, 8).astype(np.int32))


def as_sets(hexes):
    return {frozenset(nodes) for nodes in hexes.tolist()}


@pytest.mark.parametrize("name", [name for name in COARSE if name != "ring"])
def test_the_coarse_mesh_is_found_however_the_fine_one_is_numbered(name):
    coarse = COARSE[name]()
    fine, number = renumbered(refined(coarse), 1)
    found = find_refinement(fine.topology)
    assert set(found.vertices.tolist()) == set(number[np.unique(coarse.hexes)].tolist())
    assert as_sets(found.vertices[found.hexes]) == as_sets(number[coarse.hexes])
    again = Mesh(fine.points[found.vertices], found.hexes)
    assert again.quality().inverted == coarse.quality().inverted


@pytest.mark.parametrize("name", COARSE)
def test_interpolation_reproduces_the_trilinear_map(name):
    fine, _ = renumbered(refined(COARSE[name]()), 1)
    found, values = find_refinement(fine.topology), np.full(fine.points.shape, np.nan)
    values[found.vertices] = fine.points[found.vertices]
    found.interpolate(values, np.zeros(fine.n_nodes, dtype=bool))
    if name != "ring":  # of which the other half may be taken
        np.testing.assert_allclose(values, fine.points, atol=1e-12)
    assert np.isfinite(values).all()


def test_nodes_inside_follow_those_that_are_kept():
    fine, _ = renumbered(refined(grid(1)), 2)
    found, boundary = find_refinement(fine.topology), fine.topology.boundary
    x, y, z = fine.points.T
    # The transfinite map of a hex reproduces what is linear along one of its axes at least.
    given = np.column_stack([x + y**2 * z**2, y + x**2 * z**2, z + x**2 * y**2])
    values = np.where(boundary[:, None], given, 0.0)
    found.interpolate(values, boundary)
    np.testing.assert_allclose(values, given, atol=1e-14)


def removed(mesh, hex):
    hexes = np.delete(mesh.hexes, hex, axis=0)
    used, hexes = np.unique(hexes, return_inverse=True)
    return Mesh(mesh.points[used], hexes.reshape(-1, 8).astype(np.int32))


NO_REFINEMENTS = [
    grid(1),
    grid(3),
    grid(2, 2, 3),
    grid(4, 4, 5),
    removed(grid(4), [0]),
    removed(grid(4), np.arange(8)),
    removed(grid(4), [21, 22, 25, 26, 37, 38, 41, 42]),
    two(grid(2), grid(3)),
    make("five-side", size=40),
]


@pytest.mark.parametrize("mesh", NO_REFINEMENTS, ids=lambda mesh: f"{mesh.n_hexes} hexes")
def test_other_meshes_are_no_refinements(mesh):
    assert find_refinement(mesh.topology) is None


def test_a_hex_that_is_connected_otherwise_is_noticed():
    mesh = grid(4)
    hexes = mesh.hexes.copy()
    hexes[21, 6] = hexes[0, 0]
    assert find_refinement(Mesh(mesh.points, hexes).topology) is None


# Hexes that share a face are numbered alike if they traverse it in opposite directions.


#: Corners of the last cross-section of a ring of hexes that meet those of the first, and whether a numbering exists.
CLOSINGS = {"straight": ([0, 1, 2, 3], 1), "half a turn": ([2, 3, 0, 1], 1), "reflected": ([1, 0, 3, 2], 0)}


def ring_of_hexes(closing, count=6):
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
    mesh = ring_of_hexes(corners)
    assert parity(mesh)[1].tolist() == [orientable] * mesh.n_hexes
    found = found_in(mesh)
    assert ("contradictory-faces" in found) is not orientable
    if not orientable:
        assert found["contradictory-faces"].count == mesh.n_hexes
        assert not found["contradictory-faces"].mendable


def test_where_the_faces_contradict_each_other_no_hex_is_renumbered():
    mesh = ring_of_hexes(CLOSINGS["reflected"][0])
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
