"""The ways of nodes: along axes inside, along the surface where they slide."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.mesh.edge_length import shortest_edges
from hexmend.optimise.maxmin.directions import step_directions
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.grids import grid


def test_inside_there_are_both_senses_of_each_axis():
    mesh = grid(3)
    nodes = np.flatnonzero(mesh.free)
    ways = step_directions(mesh.points[nodes], np.full(nodes.size, 0.5), 0.1, nodes, np.zeros(nodes.size, bool), None)
    for k in range(nodes.size):
        own = {tuple(way) for way in ways.displacements[ways.node_index == k].tolist()}
        assert own == {tuple(sign * 0.5 * axis) for axis in np.eye(3) for sign in (1, -1)}
    np.testing.assert_array_equal(ways.projected, ways.displacements)


@pytest.mark.parametrize("mesh", [ball(3), cylinder(16, 3)], ids=["ball", "cylinder"])
def test_sliding_nodes_go_along_their_patch_or_curve_and_stay_on_it(mesh):
    mesh = slid(mesh, 0.2, 1)
    sliding, radius = SlidingBoundary(mesh), 0.2
    nodes = np.flatnonzero(sliding.mesh.free)
    x, size = mesh.points[nodes], shortest_edges(mesh.points, mesh.hexes)[nodes]
    ways = step_directions(x, size, radius, nodes, sliding.slides(nodes), sliding)
    assert (np.diff(ways.node_index) >= 0).all()
    count = {NodeClass.CURVE: 2, NodeClass.PATCH: 8}
    expected = [count.get(NodeClass(kind), 6) for kind in sliding.node_class[nodes]]
    np.testing.assert_array_equal(np.bincount(ways.node_index, minlength=nodes.size), expected)
    on = np.flatnonzero(sliding.slides(nodes)[ways.node_index])
    of = ways.node_index[on]
    there = x[of] + radius * ways.projected[on]
    np.testing.assert_allclose(sliding.project(there, nodes[of]), there, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(ways.displacements[on], axis=1), size[of])


def test_nodes_that_left_their_curve_go_along_both_patches():
    sliding = SlidingBoundary(grid(4))
    edge = np.flatnonzero((sliding.mesh.points[:, :2] == 0).all(axis=1) & (sliding.node_class == NodeClass.CURVE))[:1]
    onto = sliding.with_nodes_on_patches(edge)
    x, ones = sliding.mesh.points[edge], np.ones(1)
    ways = step_directions(x, ones, 0.1, edge, np.ones(1, dtype=bool), onto)
    there = x + 0.1 * ways.projected
    assert ways.node_index.size == 14
    np.testing.assert_allclose(there[:, :2].min(axis=1), 0, atol=1e-12)  # on one of the two
    assert all(np.isclose(ways.projected, axis, atol=1e-9).all(axis=1).any() for axis in np.eye(3))
