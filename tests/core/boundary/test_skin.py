"""Closest points of a surface of quads or triangles, by nodes and weights."""

import numpy as np
import pytest

from hexmend.boundary import ClosestPointTrees, SkinSurface
from hexmend.boundary.band import Band
from hexmend.boundary.closest_point import NearPoints
from hexmend.boundary.skin_faces import skin_faces
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


# Two-sided distance of a boundary and a surface, initially and as nodes move.


def band_of(shift=0.0, size=1.0, target=True):
    """Make a cube of edge 2, and the band of its boundary around one shifted along x."""
    mesh, other = grid(2), grid(4)
    faces = mesh.topology.boundary_faces
    surface = SkinSurface(other.points / 2 + [shift, 0, 0], other.topology.boundary_faces) if target else None
    return mesh, Band(mesh.points, faces, mesh.points, surface, size)


@pytest.mark.parametrize(("shift", "left"), [(0.3, True), (0.2, False)])
def test_nodes_have_left_the_band_where_they_are_further_than_its_tolerance_and_than_at_first(shift, left):
    mesh, band = band_of(size=0.25)
    points = mesh.points + [shift, 0, 0]
    assert (band.nodes_outside_band(points).size > 0) == left
    assert band.nodes_outside_band(mesh.points).size == 0
    at_first = band_of(0.5, size=0.25)[1]  # it was further from the beginning
    assert at_first.nodes_outside_band(mesh.points).size == 0
    assert at_first.nodes_outside_band(mesh.points - [0.1, 0, 0]).size > 0
    assert band_of(size=np.inf)[1].nodes_outside_band(points + 9).size == 0


@pytest.mark.parametrize("target", [False, True])
def test_what_was_found_at_earlier_places_does_not_change_which_nodes_have_left_the_band(target):
    mesh, band = band_of(0.1, 0.15, target)
    random, points, some_left = np.random.default_rng(3), mesh.points, set()
    for step in range(30):
        points = points.copy()
        moved = random.choice(mesh.n_nodes, 3, replace=False)
        points[moved] = mesh.points[moved] + random.uniform(-0.2, 0.2, (3, 3))
        left = band.nodes_outside_band(points)
        np.testing.assert_array_equal(left, band_of(0.1, 0.15, target)[1].nodes_outside_band(points))
        some_left.add(left.size > 0)
        if step % 7 == 0:  # other places between
            points = mesh.points
            assert band.nodes_outside_band(points).size == 0
    assert some_left == {True, False}


def halves():
    """Two materials of 2 x 1 x 1 each, the faces of their boundary and of the interface, and which are of that."""
    mesh = grid(4, 1, 1)
    mesh = mesh.replace(hex_data={"material": np.arange(4) // 2})
    faces = skin_faces(mesh).faces
    return mesh, faces, np.arange(len(faces)) >= len(mesh.topology.boundary_faces)


def test_an_interface_that_comes_near_to_the_boundary_is_as_far_from_where_it_was():
    mesh, faces, inner = halves()
    on = mesh.points[:, 0] == 2
    points = mesh.points - 1.9 * on[:, None] * [1, 0, 0]  # 1.9 from where it was, 0.1 from the end of the boundary
    apart, as_one = (Band(mesh.points, faces, mesh.points, None, 0.5, inner=one) for one in (inner, None))
    assert as_one.nodes_outside_band(points).size == 0
    np.testing.assert_array_equal(apart.nodes_outside_band(points), np.flatnonzero(on))


def test_on_another_surface_interfaces_are_not_compared():
    mesh, faces, inner = halves()
    target = SkinSurface(mesh.points, faces[~inner])
    band = Band(mesh.points, faces, mesh.points, target, 0.5, inner=inner)
    np.testing.assert_array_equal(band.samples, Band(mesh.points, faces[~inner], mesh.points, target, 0.5).samples)
    assert not band.initial_surface_deviation.distances.any()
    end = mesh.points[:, 0] == 0
    points = mesh.points + 1.9 * end[:, None] * [1, 0, 0]  # near the interface
    assert {*np.flatnonzero(end)} <= {*band.nodes_outside_band(points)}


@pytest.mark.parametrize("target", [False, True])
def test_a_band_without_width_allows_rounding(target):
    mesh, band = band_of(size=0.0, target=target)
    assert band.nodes_outside_band(mesh.points + [1e-8, 0, 0]).size == 0
    assert band.nodes_outside_band(mesh.points + [1e-6, 0, 0]).size > 0


def test_a_band_of_no_faces_has_no_nodes_outside():
    points = grid(2).points
    assert Band(points, np.empty((0, 4), np.int32), points, None, 0.0).nodes_outside_band(points + 1).size == 0


# Samples that are further than a limit from a surface, by points that were near them before.


#: Nodes of a plane at z = 0 in nine squares, each of two triangles.
PLANE = np.array([[x, y, 0.0] for x in (-9, -3, 3, 9) for y in (-9, -3, 3, 9)])
TRIANGLES = np.array(
    [[4 * i + j, 4 * i + j + 1, 4 * i + j + 5] for i in range(3) for j in range(3)]
    + [[4 * i + j, 4 * i + j + 5, 4 * i + j + 4] for i in range(3) for j in range(3)],
    dtype=np.int32,
)


def plane(points=PLANE):
    return ClosestPointTrees(points, TRIANGLES, np.zeros(len(TRIANGLES), dtype=np.int64))


def places(rng, count):
    """Make points above and below the plane, whose distance from it is that of their height."""
    return rng.uniform([-8, -8, -2], [8, 8, 2], (count, 3))


def test_the_mean_of_four_points_is_beyond_its_limit_by_its_height_whatever_was_near_before():
    rng, trees, near = np.random.default_rng(7), plane(), NearPoints(np.zeros(3000, np.int32))
    samples = rng.integers(0, 500, (3000, 4)).astype(np.int32)
    limits = rng.uniform(0.1, 1.0, 3000)
    for _ in range(4):
        points = places(rng, 500)
        examined = rng.random(3000) < 0.7
        height = np.abs(points[samples].mean(axis=1)[:, 2])
        beyond = near.means_beyond(trees, points, samples, examined, limits)
        np.testing.assert_array_equal(beyond, examined & (height > limits))
        assert 0 < beyond.sum() < examined.sum()


def test_samples_are_beyond_a_plane_that_has_moved_by_their_distance_from_where_it_is_now():
    rng, trees, near = np.random.default_rng(9), plane(), NearPoints(np.zeros(2000, np.int32))
    x, limits = places(rng, 2000), rng.uniform(0.1, 1.0, 2000)
    for height in 0.0, 0.3, -0.2, 0.0:
        examined = rng.random(2000) < 0.6
        beyond = near.beyond_moving(trees, PLANE + [0, 0, height], x, examined, limits)
        np.testing.assert_array_equal(beyond, np.flatnonzero(examined & (np.abs(x[:, 2] - height) > limits)))
        assert 0 < beyond.size < examined.sum()
