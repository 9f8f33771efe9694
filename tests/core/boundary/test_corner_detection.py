"""Nodes at bends of curves that keep a hex's corner open do not slide."""

import numpy as np
import pytest

from hexmend import METHODS, StoppingCriteria, smooth
from hexmend.boundary import NodeClass, SlidingBoundary, boundary_of
from hexmend.boundary.feature_edges.corner_detection import bend_corners
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.grids import grid


def test_bends_that_alone_keep_a_corner_open_do_not_slide():
    mesh = cylinder(16, 3)
    bends = bend_corners(mesh, boundary_of(mesh))
    assert len(bends) == 8  # four on each rim: there a square's corner has been made a bend of a circle
    assert (SlidingBoundary(mesh).boundary.node_class[bends] == NodeClass.CORNER).all()
    assert not bend_corners(grid(3), boundary_of(grid(3))).size
    assert not bend_corners(ball(3), boundary_of(ball(3))).size


def test_bends_of_inverted_corners_slide():
    mesh = cylinder(16, 3)
    (bend, *_) = bend_corners(mesh, boundary_of(mesh))
    points = mesh.points.copy()
    points[bend, :2] *= 0.5  # behind the line between its neighbours
    pushed = mesh.with_points(points)
    assert bend not in bend_corners(pushed, boundary_of(pushed, turn=180.0))


@pytest.mark.parametrize("name", ["local-nr", "mend"])
def test_no_corner_is_flattened_on_a_straight_piece_of_its_curve(name):
    result = smooth(slid(cylinder(16, 3), 0.3), METHODS[name](boundary="slide"), StoppingCriteria(max_iterations=200))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.1


@pytest.mark.parametrize("which", [0, 5])
def test_only_the_bend_of_the_inverted_corner_slides(which):
    mesh = cylinder(16, 3)
    boundary = boundary_of(mesh)
    bends = bend_corners(mesh, boundary)
    points = mesh.points.copy()
    points[bends[which], :2] *= 0.5
    assert bend_corners(mesh.with_points(points), boundary).tolist() == np.delete(bends, which).tolist()
