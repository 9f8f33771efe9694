"""Sweeps are made again without the nodes that leave the room, and such a node stays for good after some of them."""

import numpy as np
import pytest

from hexmend.smoothers import METHODS
from hexmend.smoothers.sliding_smoother import PATIENCE, Sweeps
from tests.core.boundary.solids import ball, slid


class Wall:
    """A surface whose room ends at x = 1."""

    def nodes_outside_band(self, points):
        return np.flatnonzero(points[:, 0] > 1)


def to_the_right(told):
    """A sweep that moves all nodes that need not stay by 0.3 along x."""

    def sweep(moved, stays):
        told.append(stays.copy())
        moved[~stays] += [0.3, 0, 0]
        return len(told)

    return sweep


def test_a_sweep_is_made_again_with_the_nodes_staying_that_left():
    points, told = np.zeros((4, 3)), []
    points[3, 0] = 0.9
    moved, answer = Sweeps(Wall(), 4)(points, to_the_right(told))
    assert [one.tolist() for one in told] == [[False] * 4, [False, False, False, True]]
    assert answer == 2
    np.testing.assert_allclose(moved[:, 0], [0.3, 0.3, 0.3, 0.9])
    assert points[:, 0].tolist() == [0, 0, 0, 0.9]


def test_a_node_that_had_to_stay_often_stays_for_good():
    points, sweeps = np.zeros((2, 3)), Sweeps(Wall(), 2)
    points[1, 0] = 0.9
    counts = []
    for _ in range(PATIENCE + 2):
        told = []
        sweeps(points, to_the_right(told))
        counts.append(len(told))
    assert counts == [2] * PATIENCE + [1, 1]


def test_a_node_that_was_beyond_and_has_not_moved_holds_up_nothing():
    points, told = np.full((1, 3), 2.0), []
    moved, answer = Sweeps(Wall(), 1)(points, lambda moved, stays: told.append(1) or 7)
    assert (moved.tolist(), answer, told) == ([[2, 2, 2]], 7, [1])


def test_where_nothing_slides_a_sweep_is_a_sweep():
    moved, _ = Sweeps(None, 1)(np.full((1, 3), 5.0), to_the_right([]))
    assert moved[0, 0] == 5.3


@pytest.mark.parametrize("name", ["local-patch", "local-sd"])
def test_evaluations_of_nodes_that_slide_are_counted_too(name):
    mesh = slid(ball(3), 0.1, 1)
    diagnostics = []
    for boundary in ("fixed", "slide"):
        steps = METHODS[name](boundary=boundary).steps(mesh)
        next(steps)
        diagnostics.append(next(steps).diagnostics)
    assert diagnostics[1]["derivative_evaluations"] > diagnostics[0]["derivative_evaluations"] > 0
    assert diagnostics[1]["energy_evaluations"] > diagnostics[0]["energy_evaluations"] > 0
