"""The linear program of a step, where its solution is known."""

import numpy as np
import pytest

from hexmend.optimise.maxmin.directions import StepDirections
from hexmend.optimise.maxmin.linear_program import (
    MOVE_COST,
    LinearConstraints,
    build_program,
    lower_bounds,
    no_constraints,
    solve,
)

ENDS = np.array([[3, 5, 7, 9]], np.int32)


def along_x(*nodes):
    """Each of some nodes may go along x, forth and back."""
    of, aims = np.repeat(np.arange(len(nodes)), 2), np.tile([[1.0, 0, 0], [-1.0, 0, 0]], (len(nodes), 1))
    return np.array(nodes), StepDirections(of, aims, aims)


def slope_of(end, value):
    slopes = np.zeros((1, 4, 3))
    slopes[0, end, 0] = value
    return slopes


def test_a_corner_rises_as_far_as_its_node_can_go():
    nodes, directions = along_x(5)
    found = solve(nodes, directions, LinearConstraints(ENDS, np.zeros(1), slope_of(1, -2.0), np.ones(1)), 0.1)
    np.testing.assert_allclose(found.lengths, [0, 0.1], atol=1e-12)
    assert found.gain == pytest.approx(0.2)
    np.testing.assert_allclose(found.multipliers, [1.0])


def test_nodes_that_need_not_move_stay():
    nodes, directions = along_x(5, 7)
    found = solve(nodes, directions, LinearConstraints(ENDS, np.zeros(1), slope_of(2, 1.0), np.ones(1)), 0.1)
    np.testing.assert_allclose(found.lengths, [0, 0, 0.1, 0], atol=1e-12)
    program = build_program(
        nodes, directions, LinearConstraints(ENDS, np.zeros(1), slope_of(2, 1.0), np.ones(1)), 0.1, False
    )
    np.testing.assert_allclose(program.cost, [MOVE_COST / 2] * 4 + [-1])
    np.testing.assert_allclose(program.lower, 0)
    np.testing.assert_allclose(program.upper, [0.1] * 4 + [2])


def test_two_corners_hold_each_other_where_they_want_opposite_ways():
    nodes, directions = along_x(5)
    both = LinearConstraints(ENDS, np.zeros(1), slope_of(1, 1.0), np.ones(1)).concatenate(
        LinearConstraints(ENDS, np.zeros(1), slope_of(1, -1.0), np.ones(1))
    )
    found = solve(nodes, directions, both, 0.1)
    assert found.gain == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose(found.multipliers, [0.5, 0.5], atol=MOVE_COST)


def test_a_bound_limits_how_far_a_node_goes_whether_it_is_near_at_first_or_turns_out_to_bind():
    nodes, directions = along_x(5)
    corner = LinearConstraints(ENDS, np.zeros(1), slope_of(1, 1.0), np.ones(1))
    for room, slope in ((0.02, -1.0), (0.2, -4.0)):  # at a radius of 0.1 all that is nearer than 0.03 is taken at once
        found = solve(
            nodes, directions, corner.concatenate(lower_bounds(ENDS, np.array([room]), slope_of(1, slope))), 0.1
        )
        np.testing.assert_allclose(found.lengths, [room / -slope, 0], atol=1e-9)
        assert found.gain == pytest.approx(room / -slope)
    assert len(corner.concatenate(no_constraints()).nodes) == 1


def test_the_least_falls_only_where_it_may():
    nodes, directions = along_x(5)
    corner = LinearConstraints(ENDS, np.zeros(1), slope_of(1, -1.0), np.ones(1))
    beyond = corner.concatenate(lower_bounds(ENDS, np.array([-0.05]), slope_of(1, 1.0)))
    assert solve(nodes, directions, beyond, 0.1) is None
    found = solve(nodes, directions, beyond, 0.1, may_decrease=True)
    np.testing.assert_allclose(found.lengths, [0.05, 0], atol=1e-9)
    assert found.gain == pytest.approx(-0.05)


@pytest.mark.parametrize("slope", [1e15, 1e300, np.inf, np.nan])
def test_slopes_that_no_solver_takes_have_no_solution(slope):
    nodes, directions = along_x(5)
    constraints = LinearConstraints(ENDS, np.zeros(1), slope_of(1, slope), np.ones(1))
    assert solve(nodes, directions, constraints, 0.1) is None
