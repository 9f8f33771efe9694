"""The minimum scaled Jacobian is raised as far as it goes; what stops it is told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from hexmend.boundary import SlidingBoundary, surface_change
from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.maxmin.corner_values import gradients, scaled_jacobians
from hexmend.optimise.maxmin.linear_program import MOVE_COST
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)


def raised(raising, **limits):
    """What a `MaxMinOptimiser` yields: its steps, and where it ends."""
    *steps, limit = raising.steps(**limits)
    assert isinstance(limit, ActiveCorners)
    return steps, limit


def steepest(mesh, points, limit):
    """The rate at which the corners of a limit can be raised together, no node going further than its shortest edge."""
    ends = mesh.hexes[limit.hexes[:, None], CORNER_TETRAHEDRA[limit.corners]]
    _, derivatives = gradients(points, ends)
    slopes = np.zeros((len(ends), *points.shape))
    for of, at, slope in zip(slopes, ends, derivatives, strict=True):
        of[at] = slope
    slopes *= shortest_edges(points, mesh.hexes)[:, None]
    slopes = slopes[:, mesh.free].reshape(len(ends), -1)
    ways = slopes.shape[1]
    solved = linprog(
        np.append(np.zeros(ways), -1.0),
        A_ub=np.column_stack([-slopes, np.ones(len(ends))]),
        b_ub=np.zeros(len(ends)),
        bounds=[(-1, 1)] * ways + [(None, None)],
    )
    return -solved.fun


def one_free_node(seed):
    """A cube of eight hexes, its boundary rough, so that corners of several hexes hold each other."""
    mesh = grid(2)
    return mesh.with_points(mesh.points + np.random.default_rng(seed).uniform(-0.25, 0.25, mesh.points.shape))


@pytest.mark.slow
@settings(max_examples=20)
@given(seeds, st.floats(0.1, 1.2))
def test_the_least_rises_from_step_to_step_and_fixed_nodes_stay(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    raising = MaxMinOptimiser(mesh, mesh.points)
    least = raising.corners.active_minimum
    steps, limit = raised(raising)
    for step in steps:
        assert step.least > least
        least = step.least
        assert step.least == scaled_jacobians(step.points, mesh.hexes).min()  # that of the boundary's corners too
        np.testing.assert_array_equal(step.points[mesh.fixed], mesh.points[mesh.fixed])
    assert limit.least == raising.corners.active_minimum == least
    np.testing.assert_array_equal(raising.corners.values, scaled_jacobians(raising.points, mesh.hexes))


@pytest.mark.slow
@settings(max_examples=20)
@given(seeds, st.floats(0.1, 0.5))
def test_a_scrambled_grid_is_raised_to_that_of_cubes(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    raising = MaxMinOptimiser(mesh, mesh.points)
    raised(raising)
    assert raising.corners.active_minimum > 0.99


@given(seeds)
def test_corners_at_the_end_hold_each_other(seed):
    mesh = one_free_node(seed)
    raising = MaxMinOptimiser(mesh, mesh.points)
    _, limit = raised(raising)
    values = raising.corners.values[limit.hexes, limit.corners]
    assert np.ptp(values) < 1e-3
    assert (mesh.free[mesh.hexes[limit.hexes[:, None], CORNER_TETRAHEDRA[limit.corners]]]).any(axis=1).all()
    assert steepest(mesh, raising.points, limit) < 3 * MOVE_COST + 1e-6  # each axis of a node has its price
    random, size = np.random.default_rng(seed), shortest_edges(raising.points, mesh.hexes)[:, None]
    for reach in 1e-2, 1e-3:
        way = random.uniform(-1, 1, mesh.points.shape) * size * mesh.free[:, None]
        there = scaled_jacobians(raising.points + reach * way, mesh.hexes)[limit.hexes, limit.corners]
        assert there.min() < values.min() + 3 * MOVE_COST * reach + 10 * reach**2


@given(seeds, st.integers(0, 7), st.integers(0, 7))
def test_coinciding_nodes_are_no_end(seed, one, other):
    mesh = scrambled(grid(3), 0.1, seed)
    points, inner = mesh.points.copy(), int(np.flatnonzero(mesh.free)[one])
    ring = mesh.topology.rings[inner]
    points[inner] = points[ring[other % len(ring)]]
    raising = MaxMinOptimiser(mesh.with_points(points), points)
    with np.errstate(all="raise"):
        raised(raising)
    assert np.isfinite(raising.points).all()
    np.testing.assert_array_equal(raising.points[mesh.fixed], points[mesh.fixed])


@pytest.mark.slow
@settings(max_examples=10)
@given(seeds, st.sampled_from(["ball", "cylinder"]), st.floats(0.02, 0.2))
def test_the_boundary_slides_in_its_room(seed, solid, share):
    mesh = slid({"ball": ball(3), "cylinder": cylinder(16, 3)}[solid], 0.25, seed)
    room = share * mesh.mean_edge_length
    sliding = SlidingBoundary(mesh, max_deviation=room)
    raising = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
    before = raising.corners.active_minimum
    steps, _ = raised(raising)
    assert (np.diff([before, *(step.least for step in steps)]) > 0).all()
    assert raising.envelope.largest_deviation(raising.points) <= room * (1 + 1e-9)
    change = surface_change(mesh, mesh.with_points(raising.points))
    assert change.max_distance <= room * (1 + 1e-9)
    np.testing.assert_array_equal(raising.points[sliding.mesh.fixed], mesh.points[sliding.mesh.fixed])
    on = raising.points[sliding.nodes]
    np.testing.assert_allclose(sliding.project(on), on, atol=1e-9)
