"""Left-handed hexes are renumbered with their side sets; hexes that their nodes invert are not."""

import numpy as np
import pytest

from hexmend import Mesh, MeshError, iterate, smooth
from hexmend.doctor import repair
from hexmend.mesh import orientation
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes, mirror_hexes, with_consistent_orientation
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase
from tests.core.grids import grid, scrambled, with_edge_midpoints


def mirrored(mesh, which):
    """Number some hexes of a mesh left-handed, with the side sets on the same faces."""
    hexes = mesh.hexes.copy()
    hexes[which] = hexes[which][:, MIRRORED_CORNERS]
    return mesh.rebuilt(hexes=hexes, side_sets={})


def two_grids():
    """Make two disconnected grids, of 8 hexes and of 1."""
    one, other = grid(2), grid(1)
    points = np.concatenate([one.points, other.points + 5])
    return Mesh(points, np.concatenate([one.hexes, other.hexes + one.n_nodes]))


def nodes_of(mesh, name):
    """Return the nodes of each face of a side set, as sets."""
    return [frozenset(mesh.hexes[hexa, FACES[face]].tolist()) for hexa, face in mesh.side_sets[name]]


@pytest.mark.parametrize("chunk", [1, 2, 100])
def test_hexes_that_are_flat_up_to_rounding_do_not_count_wherever_a_chunk_ends(chunk, monkeypatch):
    monkeypatch.setattr(orientation, "_CHUNK", chunk)
    mesh = grid(2, 1, 1)
    points = mesh.points.copy()
    flat = points[:, 0] == 2
    points[flat] = points[flat] * [0, 1, 1] + [1 - 1e-15, 0, 0]
    mesh = mirrored(mesh.with_points(points), [True, True])
    volumes = corner_determinants(points, mesh.hexes, np.arange(2)).sum(axis=1)
    assert volumes[0] < 0 < volumes[1] < 1e-13
    assert left_handed_hexes(mesh).all()


def test_faces_of_side_sets_stay_where_they_are():
    mesh = grid(2)
    rows = np.array([(hexa, face) for hexa in range(8) for face in range(6)])
    mesh = mesh.replace(side_sets={"all": rows})
    which = np.arange(8) % 3 == 0
    back = mirror_hexes(mesh, which)
    assert nodes_of(back, "all") == nodes_of(mesh, "all")
    np.testing.assert_array_equal(back.side_sets["all"][:, 0], rows[:, 0])
    assert (back.side_sets["all"][~which[rows[:, 0]]] == rows[~which[rows[:, 0]]]).all()
    np.testing.assert_array_equal(mirror_hexes(back, which).side_sets["all"], rows)
    np.testing.assert_array_equal(mesh.side_sets["all"], rows)  # the given mesh is as it was


@pytest.mark.parametrize("which", [[0, 1, 2, 3, 4, 5, 6, 7], [8], list(range(9))])
def test_whole_parts_are_turned_and_a_note_counts_them(which):
    mesh = two_grids()
    wrong = mirrored(mesh, np.isin(np.arange(9), which))
    np.testing.assert_array_equal(np.flatnonzero(left_handed_hexes(wrong)), which)
    back = with_consistent_orientation(wrong)
    assert (corner_determinants(back.points, back.hexes) > 0).all()
    assert back.renumbered == "parts"
    assert len(back.notes) == 1
    assert back.notes[0].startswith(
        "All hexes" if len(which) == 9 else f"{count_phrase(len(which), 'hex', 'hexes')}, which make"
    )


def lattice_pattern(name):
    """Mark hexes of a lattice of 4 x 3 x 3, (36,) bool."""
    x, y, z = np.arange(36) % 4, np.arange(36) // 4 % 3, np.arange(36) // 12
    return {
        "checkerboard": (x + y + z) % 2 == 0,
        "layer": z == 1,
        "one hex": np.arange(36) == 17,
        "all but one": np.arange(36) != 17,
        "block": (x < 2) & (y < 2),
        "most": x > 0,
    }[name]


@pytest.mark.parametrize("name", ["checkerboard", "layer", "one hex", "all but one", "block", "most"])
def test_left_handed_hexes_of_a_lattice_are_renumbered_exactly_and_a_note_counts_them(name):
    mesh, which = grid(4, 3, 3), lattice_pattern(name)
    wrong = mirrored(scrambled(mesh, 0.1), which)
    np.testing.assert_array_equal(left_handed_hexes(wrong), which)
    back = with_consistent_orientation(wrong)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    (note,) = back.notes
    assert note.startswith(f"{count_phrase(which.sum(), 'hex', 'hexes')}, unlike")
    assert back.renumbered == "hexes"


@pytest.mark.parametrize("flat", [[0, 1, 2, 3], [4, 5, 6, 7]])
def test_flat_hexes_follow_their_neighbours(flat):
    mesh = grid(2, 2, 3)
    points = mesh.points.copy()
    points[points[:, 2] == (0 if flat[0] == 0 else 2), 2] = 1  # the lowest layer, or that above it, has no height
    mesh = mesh.with_points(points)
    assert (corner_determinants(mesh.points, mesh.hexes)[flat] == 0).all()
    which = np.arange(12) % 3 == 0
    np.testing.assert_array_equal(with_consistent_orientation(mirrored(mesh, which)).hexes, mesh.hexes)
    assert with_consistent_orientation(mesh) is mesh


@pytest.mark.parametrize("amplitude", [1.3, 1.5])
def test_hexes_that_their_nodes_invert_are_left_as_they_are_and_others_renumbered_among_them(amplitude):
    mesh = scrambled(grid(4, 3, 3), amplitude)
    inverted = corner_determinants(mesh.points, mesh.hexes).sum(axis=1) < 0
    assert inverted.any()
    assert with_consistent_orientation(mesh) is mesh
    for which in (lattice_pattern("layer"), np.ones(36, dtype=bool)):
        np.testing.assert_array_equal(with_consistent_orientation(mirrored(mesh, which)).hexes, mesh.hexes)


def test_a_node_far_outside_does_not_turn_the_whole_mesh():
    mesh = grid(4, 3, 3)
    points = mesh.points.copy()
    points[0] = 1e6
    assert corner_determinants(points, mesh.hexes[:1]).sum() < 0
    mesh = mesh.with_points(points)
    assert with_consistent_orientation(mesh) is mesh


def test_mid_nodes_and_side_sets_follow_their_hexes():
    mesh, which = grid(4, 3, 3), lattice_pattern("checkerboard")
    rows = np.array([(hexa, face) for hexa in range(36) for face in range(6)])
    mesh = with_edge_midpoints(mesh).replace(side_sets={"all": rows})
    back = with_consistent_orientation(mirror_hexes(mesh, which))
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    np.testing.assert_array_equal(back.mid_nodes, mesh.mid_nodes)
    np.testing.assert_array_equal(back.side_sets["all"], rows)


def test_a_run_refuses_left_handed_hexes_and_names_the_remedy():
    wrong = mirrored(scrambled(grid(3), 0.1), np.arange(27) == 13)
    with pytest.raises(MeshError, match=r"1 hex, unlike its neighbours, is numbered inside out .* hexmend repair"):
        iterate(wrong)
    assert smooth(repair(wrong)[0]).after.inverted == 0


def test_volumes_far_from_the_origin_are_those_of_the_hexes():
    mesh = grid(2)
    np.testing.assert_allclose(orientation.signed_volumes(mesh.points + 1e5, mesh.hexes), 1, rtol=1e-6)
