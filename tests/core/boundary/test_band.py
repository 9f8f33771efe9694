"""How far a boundary and another surface are apart, both ways, at first and as nodes move."""

import numpy as np
import pytest

from hexmend.boundary.band import Band
from hexmend.boundary.comparison import SkinSurface
from tests.core.grids import grid


def room_of(shift=0.0, size=1.0, target=True):
    """The boundary of a cube of edge 2, and one that is shifted along x as its surface."""
    mesh, other = grid(2), grid(4)
    faces = mesh.topology.boundary_faces
    surface = SkinSurface(other.points / 2 + [shift, 0, 0], other.topology.boundary_faces) if target else None
    return mesh, Band(mesh.points, faces, mesh.points, surface, size)


def test_distances_at_first_are_those_from_samples_of_the_surface_to_the_boundary():
    mesh, room = room_of(0.25)
    far, nodes, weights = room.behind_at_first
    samples = room.target.samples()
    boundary = SkinSurface(mesh.points, mesh.topology.boundary_faces)
    assert far.shape == (len(samples),)
    np.testing.assert_allclose(far, boundary.distances(samples), atol=1e-12)
    assert far.max() == pytest.approx(0.25)
    places = np.einsum("sk,ski->si", weights, mesh.points[nodes])
    np.testing.assert_allclose(np.linalg.norm(samples - places, axis=1), far, atol=1e-12)


@pytest.mark.parametrize("shift", [0.0, 0.25])
def test_what_is_further_than_a_room_is_found_and_nothing_else(shift):
    mesh, room = room_of(shift)
    every = np.arange(len(room.middles))
    far = room.target.distances(mesh.points[room.middles].mean(axis=1))
    for most in (1e-3, 0.1, 0.2499, 0.2501):
        off = room.off(mesh.points, every, most)
        np.testing.assert_array_equal(off.which, np.flatnonzero(far > most))
        np.testing.assert_allclose(off.far, far[off.which], atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(off.away, axis=1), (off.far > 0).astype(float), atol=1e-12)
        assert off.weights.shape == off.nodes.shape == (len(off.which), 4)
        behind = room.behind(mesh.points, room=most)
        at_first = room.behind_at_first[0]
        np.testing.assert_array_equal(behind.which, np.flatnonzero(at_first > most))


def test_each_place_may_have_a_room_of_its_own():
    mesh, room = room_of(0.25)
    every = np.arange(len(room.middles))
    far = room.target.distances(mesh.points[room.middles].mean(axis=1))
    own = np.where(every % 2, 0.1, 0.3)
    np.testing.assert_array_equal(room.off(mesh.points, every, own).which, np.flatnonzero(far > own))


def test_a_boundary_is_its_own_surface_where_no_other_is_given():
    mesh, room = room_of(target=False)
    far, nodes, _ = room.behind_at_first
    assert not far.any()
    np.testing.assert_array_equal(nodes, room.middles)
    points = mesh.points + [0, 0, 0.5]
    assert room.off(points, np.arange(len(room.middles))).far.max() == pytest.approx(0.5)
    assert room.behind(points).far.max() == pytest.approx(0.5)


@pytest.mark.parametrize(("shift", "left"), [(0.3, True), (0.2, False)])
def test_nodes_have_left_their_room_where_they_are_further_than_it_and_than_at_first(shift, left):
    mesh, room = room_of(size=0.25)
    points = mesh.points + [shift, 0, 0]
    assert (room.beyond(points).size > 0) == left
    assert room.beyond(mesh.points).size == 0
    at_first = room_of(0.5, size=0.25)[1]  # it was further from the beginning
    assert at_first.beyond(mesh.points).size == 0
    assert at_first.beyond(mesh.points - [0.1, 0, 0]).size > 0
    assert room_of(size=np.inf)[1].beyond(points + 9).size == 0


def test_places_that_move_with_a_node_are_its_own_and_those_of_its_edges_and_faces():
    _, room = room_of()
    at = room.middles_at(np.array([0]))
    assert (room.middles[at] == 0).any(axis=1).all()
    assert len(at) == (room.middles == 0).any(axis=1).sum() == 7  # a corner: itself, three edges, three faces


def test_a_room_is_no_narrower_than_rounding_of_the_size_of_the_boundary():
    mesh, room = room_of(size=0.0)
    assert room.room == pytest.approx(1e-9 * np.sqrt(12))
    assert room_of(size=0.5)[1].room == 0.5
    nothing = Band(mesh.points, np.empty((0, 4), np.int32), mesh.points, None, 0.0)
    assert nothing.room == 0
