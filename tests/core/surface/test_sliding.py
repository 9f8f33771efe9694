"""Which nodes of a boundary slide, and what the methods are handed of it."""

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.run import Stop, smooth
from hexmend.smoothers import METHODS
from hexmend.surface import Kind, Sliding, boundary_of
from hexmend.surface.sliding import kept_bends
from tests.core.grids import grid
from tests.core.surface.solids import ball, cylinder, slid


def test_bends_that_alone_hold_a_corner_open_are_kept():
    mesh = cylinder(16, 3)
    bends = kept_bends(mesh, boundary_of(mesh))
    assert len(bends) == 8  # four on each rim: there a square's corner has been made a bend of a circle
    assert (Sliding(mesh).boundary.kind[bends] == Kind.CORNER).all()
    assert not kept_bends(grid(3), boundary_of(grid(3))).size
    assert not kept_bends(ball(3), boundary_of(ball(3))).size


def test_bends_of_inverted_corners_slide():
    mesh = cylinder(16, 3)
    (bend, *_) = kept_bends(mesh, boundary_of(mesh))
    points = mesh.points.copy()
    points[bend, :2] *= 0.5  # behind the line between its neighbours
    pushed = mesh.with_points(points)
    assert bend not in kept_bends(pushed, boundary_of(pushed, turn=180.0))


@pytest.mark.parametrize("name", ["local-nr", "global-sd", "mend"])
def test_no_corner_is_flattened_on_a_straight_piece_of_its_curve(name):
    result = smooth(slid(cylinder(16, 3), 0.3), METHODS[name](boundary="slide"), Stop(max_iterations=200))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.1


def test_rings_of_sliding_nodes_are_on_their_own_curves_and_patches():
    mesh = make("bridge-sharp", size=500)
    sliding = Sliding(mesh)
    kind, part, rings = sliding.boundary.kind, sliding.boundary.part, sliding.rings
    for node in range(mesh.n_nodes):
        whole, ring = mesh.topology.rings[node], rings[node]
        assert set(ring) <= set(whole)
        if kind[node] < Kind.CURVE:
            np.testing.assert_array_equal(ring, whole)
        elif kind[node] == Kind.CURVE:
            assert len(ring) == 2
            assert all(part[other] == part[node] or kind[other] == Kind.CORNER for other in ring)
        else:
            assert len(ring) >= 3
            assert all(kind[other] != Kind.INSIDE for other in ring)


def test_a_mesh_keeps_the_surface_that_it_is_told_to():
    mesh = ball(3)
    moved = mesh.keeping_surface().with_points(1.1 * mesh.points)
    np.testing.assert_array_equal(moved.surface, mesh.points)
    np.testing.assert_array_equal(moved.keeping_surface().with_points(mesh.points).surface, mesh.points)
    np.testing.assert_array_equal(mesh.with_points(1.1 * mesh.points).surface, 1.1 * mesh.points)
    np.testing.assert_array_equal(Sliding(moved).mesh.points, moved.points)
    places = Sliding(moved).put_back(moved.points[Sliding(moved).nodes])
    np.testing.assert_allclose(np.linalg.norm(places, axis=1), 1, atol=0.2)
