"""Nodes that leave the surface where that raises the minimum scaled Jacobian, and how they are brought back near it."""

import itertools

import numpy as np
import pytest

from hexmend.boundary import NodeClass, SlidingBoundary, surface_change
from hexmend.io import read
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid
from tests.core.optimise.maxmin.test_slp import raised


def lifted(sliding, points, wide, times):
    """A boundary that has left its surface where that raises the least, up to so far, and as often as it has to."""
    raising = MaxMinOptimiser(sliding.mesh, points, sliding)
    raising.envelope.limit_to(wide)
    for _ in range(times):
        _, limit = raised(raising, target=0.5)
        if not raising.release(limit):
            break
    return raising


def test_lifted_nodes_leave_the_surface_and_are_brought_into_their_room():
    mesh = slid(ball(3), 0.3, 1)
    edge = mesh.mean_edge_length
    sliding = SlidingBoundary(mesh)
    raising = lifted(sliding, mesh.points, edge, 4)
    assert raising.envelope.released.any()
    assert sliding.slides(np.flatnonzero(raising.envelope.released)).all()
    far = raising.envelope.largest_deviation(raising.points)
    assert 0.1 * edge < far <= edge * (1 + 1e-9)
    for step in raising.return_to_band(0.1 * edge):
        assert np.isfinite(step.points).all()
    assert raising.envelope.largest_deviation(raising.points) <= 0.1 * edge * (1 + 1e-5)
    assert surface_change(mesh, mesh.with_points(raising.points)).max <= 0.1 * (1 + 1e-5)
    assert raising.envelope.max_deviation == 0.1 * edge
    least = raising.corners.active_minimum
    steps, _ = raised(raising)
    assert all(step.least > least for step in steps)
    assert raising.envelope.largest_deviation(raising.points) <= 0.1 * edge * (1 + 1e-5)


def test_nothing_is_lifted_off_a_surface_without_room():
    mesh = slid(ball(3), 0.3, 1)
    sliding = SlidingBoundary(mesh, max_deviation=0.0)
    raising = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
    _, limit = raised(raising)
    raising.envelope.limit_to(0.0)
    assert not raising.release(limit)
    assert not raising.envelope.released.any()
    fixed = MaxMinOptimiser(mesh, mesh.points)
    assert not fixed.release(raised(fixed)[1])


@pytest.mark.slow
def test_a_real_mesh_is_brought_into_its_room_both_ways(real_mesh):
    mesh = read(real_mesh("bunny.vtk"))
    room = 0.4 * mesh.mean_edge_length
    sliding = SlidingBoundary(mesh, 40.0)
    raising = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
    raising.envelope.limit_to(1.5 * mesh.mean_edge_length)
    for _ in range(5):
        for step in itertools.islice(raising.steps(0.0), 10):
            limit = step
        if not isinstance(limit, ActiveCorners) or not raising.release(limit):
            break
    assert raising.envelope.largest_deviation(raising.points) > room
    for _ in raising.return_to_band(room):
        pass
    assert raising.envelope.largest_deviation(raising.points) <= room * (1 + 1e-5)
    change = surface_change(mesh, mesh.with_points(raising.points))
    assert change.max_distance <= room * (1 + 1e-5)


def test_fixed_nodes_are_let_go_where_they_hold_an_inverted_corner_and_nowhere_else():
    """A corner of the solid, which has sharp edges, yields only where it would leave a hex without any volume."""
    mesh = grid(2)
    for least, yields in ((-0.1, True), (0.0, True), (0.1, False)):
        sliding = SlidingBoundary(mesh, max_deviation=0.5)
        raising = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
        raising.envelope.release(sliding.nodes)  # those of the edges and faces have left already
        assert raising.release(ActiveCorners(least, np.array([0]), np.array([0]))) == yields
        assert raising.mesh.free[0] == raising.envelope.released[0] == yields


def test_nodes_of_curves_go_onto_the_patches_before_they_leave_the_surface_unless_a_hex_is_inverted():
    mesh = grid(4)
    for least in (0.1, -0.1):
        sliding = SlidingBoundary(mesh, max_deviation=0.5)
        raising = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
        active = ActiveCorners(least, np.array([0]), np.array([0]))  # at a corner of the block, with three edges
        ends = mesh.hexes[0, [1, 3, 4]]
        assert (sliding.node_class[ends] == NodeClass.CURVE).all()
        assert raising.release(active)
        envelope = raising.envelope
        assert envelope.released[ends].all()
        assert envelope.slides(ends).all() == (least > 0)
        if least > 0:
            assert (envelope.sliding.node_class[ends] == NodeClass.PATCH).all()
            fork = raising.fork()
            assert raising.release(active)
            assert fork.envelope.slides(ends).all()
        assert envelope.off_surface[ends].all()
        assert not envelope.slides(ends).any()
        assert not envelope.released[mesh.hexes[0, 0]]
