"""Two-sided distance of a boundary and a surface, initially and as nodes move."""

import numpy as np
import pytest

from hexmend.boundary.band import Band
from hexmend.boundary.skin_faces import skin_faces
from hexmend.boundary.skin_surface import SkinSurface
from tests.core.grids import grid


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
