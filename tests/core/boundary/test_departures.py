"""Nodes that have left their corner, curve or patch."""

import numpy as np
import pytest

from hexmend.boundary import Keeping, NodeClass, SlidingBoundary, departures
from tests.core.boundary.solids import slid
from tests.core.grids import grid


def test_nodes_that_slide_are_kept_exactly():
    mesh = grid(4)
    left = departures(mesh, slid(mesh, 0.3))
    assert not left.nodes.size
    assert left.sentence == ""
    np.testing.assert_array_equal(left.keeping == Keeping.INSIDE, mesh.interior)
    assert (left.keeping[mesh.topology.boundary] == Keeping.EXACT).all()


def test_nodes_that_leave_are_counted_by_their_class():
    mesh = grid(4)
    node_class = SlidingBoundary(mesh).boundary.node_class
    corner, curve, patch = (np.flatnonzero(node_class == of)[0] for of in list(NodeClass)[1:])
    points = mesh.points.copy()
    points[corner] += 0.2  # away from its place
    points[curve] += 0.1 * (mesh.points.mean(axis=0) - points[curve]) / 2
    points[patch] += [0.05, 0.05, 0.05]
    left = departures(mesh, mesh.with_points(points))
    assert left.nodes.tolist() == sorted([corner, curve, patch])
    assert list(left.counts.values()) == [1, 1, 1]
    assert left.max == pytest.approx(0.2 * np.sqrt(3))
    assert (left.keeping[left.nodes] == Keeping.WITHIN_TOLERANCE).all()
    assert left.to_dict() | {"max": 0} == left.counts | {"max": 0, "nodes": left.nodes.tolist()}
    assert "1 corner has left its place, 1 node has left its curve, 1 node has left its patch" in left.sentence
