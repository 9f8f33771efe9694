"""Left-handed parts are renumbered with their side sets; single inverted hexes are not."""

import numpy as np
import pytest

from hexmend.mesh import orientation
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import (
    MIRRORED_CORNERS,
    mirror_hexes,
    mirrored_parts,
    parts_of,
    with_consistent_orientation,
)
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase
from tests.core.grids import grid


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
    points[flat] = points[flat] * [0, 1, 1] + [1 + 1e-15, 0, 0]
    mesh = mirrored(mesh.with_points(points), [True, False])
    volumes = corner_determinants(points, mesh.hexes, np.arange(2)).sum(axis=1)
    assert volumes[0] < 0 < volumes[1] < 1e-13
    assert mirrored_parts(mesh).all()


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


def test_turning_changes_the_sign_of_every_determinant_of_these_hexes_alone():
    mesh, which = grid(2), np.arange(8) < 3
    before, after = (corner_determinants(one.points, one.hexes) for one in (mesh, mirror_hexes(mesh, which)))
    assert (before > 0).all()
    assert (after[which] < 0).all()
    assert (after[~which] > 0).all()


@pytest.mark.parametrize("which", [[0, 1, 2, 3, 4, 5, 6, 7], [8], list(range(9))])
def test_whole_parts_are_turned_and_a_note_counts_them(which):
    mesh = two_grids()
    wrong = mirrored(mesh, np.isin(np.arange(9), which))
    np.testing.assert_array_equal(np.flatnonzero(mirrored_parts(wrong)), which)
    back = with_consistent_orientation(wrong)
    assert (corner_determinants(back.points, back.hexes) > 0).all()
    assert len(back.notes) == 1
    assert back.notes[0].startswith(
        "All hexes" if len(which) == 9 else f"{count_phrase(len(which), 'hex', 'hexes')}, which make"
    )


@pytest.mark.parametrize("which", [[], [0], [0, 1, 2, 3, 4, 5, 6]])
def test_a_part_with_one_sound_hex_is_left_as_it_is(which):
    wrong = mirrored(two_grids(), np.isin(np.arange(9), which))
    assert not mirrored_parts(wrong).any()
    assert with_consistent_orientation(wrong) is wrong


def test_parts_hang_together_by_nodes_and_are_counted_from_0():
    assert parts_of(two_grids()).tolist() == [0] * 8 + [1]
    one = grid(1)
    far = one.points + 1  # it has a node in common with the first
    points = np.concatenate([one.points, far[1:], one.points + 9])
    shared = np.concatenate([[7], np.arange(8, 15)])
    assert np.allclose(one.points[7], far[0])
    mesh = Mesh(points, np.stack([one.hexes[0], shared[one.hexes[0]], 15 + one.hexes[0]]))
    assert parts_of(mesh).tolist() == [0, 0, 1]
