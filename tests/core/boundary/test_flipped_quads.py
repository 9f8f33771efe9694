"""Moves that flip quads are undone."""

import numpy as np

from hexmend.boundary import SlidingBoundary
from tests.core.grids import grid


def folded():
    """Make a box with a step that takes a node of its top beyond its neighbour."""
    mesh = grid(4)
    node = int(np.flatnonzero((mesh.points == [2, 2, 4]).all(axis=1))[0])
    after = mesh.points.copy()
    after[node, 0] += 2.5
    return mesh, SlidingBoundary(mesh), node, after


def test_nodes_of_turned_quads_stay_where_they_are():
    mesh, sliding, node, after = folded()
    turned = sliding.flipped_quads(mesh.points, after)
    assert turned.size
    assert (sliding.boundary.faces[turned] == node).any(axis=1).all()
    after[0] += 0.01  # of another quad, which is sound
    back = sliding.reject_moves(mesh.points, after)
    np.testing.assert_array_equal(back[node], mesh.points[node])
    np.testing.assert_array_equal(back[0], after[0])
