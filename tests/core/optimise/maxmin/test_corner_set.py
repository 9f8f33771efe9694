"""Which corners can be moved, and what they are worth as nodes move."""

import numpy as np

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.maxmin.corner_set import MovableCorners
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from tests.core.grids import grid, scrambled


def movable(mesh):
    return mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)


def test_fixed_corners_are_not_raised():
    mesh = scrambled(grid(3), 0.4, 1)
    corners = MovableCorners(mesh, mesh.points)
    values = scaled_jacobians(mesh.points, mesh.hexes)
    np.testing.assert_array_equal(np.isfinite(corners.active_values), movable(mesh))
    assert corners.active_minimum == corners.movable_minimum == values[movable(mesh)].min()
    locked = corners.locked_below(np.inf)
    assert sorted(locked) == sorted(np.flatnonzero(~movable(mesh)))
    assert (np.diff(values.ravel()[locked]) >= 0).all()


def test_settled_corners_take_along_those_that_have_no_other_node():
    mesh = grid(2)  # of one free node
    corners = MovableCorners(mesh, mesh.points)
    (one, *_) = np.flatnonzero(movable(mesh))
    nodes = np.flatnonzero(mesh.free)
    np.testing.assert_array_equal(corners.movable(np.arange(mesh.n_nodes)), nodes)
    corners.freeze(np.array([one]))
    np.testing.assert_array_equal(corners.frozen, movable(mesh))
    assert corners.active_minimum == np.inf > corners.movable_minimum
    assert corners.movable(nodes).size == 0
    corners.unfreeze()
    assert not corners.frozen.any()
    np.testing.assert_array_equal(corners.movable(nodes), nodes)


def test_values_follow_the_hexes_at_nodes_that_moved():
    mesh = scrambled(grid(3), 0.2, 2)
    corners = MovableCorners(mesh, mesh.points)
    (node, *_) = np.flatnonzero(mesh.free)
    points = mesh.points.copy()
    points[node] += 0.1
    hexes = corners.hexes_at(np.array([node]))
    np.testing.assert_array_equal(hexes, np.flatnonzero((mesh.hexes == node).any(axis=1)))
    corners.update(points, hexes)
    np.testing.assert_array_equal(corners.values, scaled_jacobians(points, mesh.hexes))
    ends = corners.nodes_of(8 * hexes)
    np.testing.assert_array_equal(ends, mesh.hexes[hexes][:, CORNER_TETRAHEDRA[0]])


def test_corners_are_of_one_group_where_they_share_free_nodes():
    mesh = grid(4)
    corners = MovableCorners(mesh, mesh.points)
    first, last = (np.flatnonzero(mesh.free)[at] for at in (0, -1))
    here, there = (np.flatnonzero(mesh.hexes.ravel() == node) for node in (first, last))  # with it at their apexes
    some = np.array([here[0], there[0], here[1], there[1]])
    assert corners.groups(some).tolist() == [0, 1, 0, 1]
    every = np.flatnonzero(movable(mesh))
    assert set(corners.groups(np.concatenate([some, every]))) == {0}
    assert corners.groups(here[:0]).size == 0
