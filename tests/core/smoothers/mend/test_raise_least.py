"""How groups of corners that hold each other are left behind, on a stand-in that only says where it ends."""

import numpy as np
import pytest

from hexmend.optimise.maxmin.slp_step import ActiveCorners, MaxMinStep
from hexmend.smoothers.mend.maxmin import MAXMIN, maximise_minimum
from tests.core.smoothers.mend.walks import walked


def limit_at(least, hexes=1):
    return ActiveCorners(least, np.arange(hexes), np.zeros(hexes, np.int64))


class StandIn:
    """Makes some steps, then ends at the next of some limits; records what is done about each."""

    def __init__(self, limits, steps=0, releases=0):
        self.points, self.least = np.zeros((8, 3)), -1.0
        self._limits, self._steps, self._releases = iter(limits), steps, releases
        self.asked, self.frozen, self.released, self.released_around = [], [], [], []
        self.programs = 0

    def steps(self, aim, patient_below):
        self.asked.append(aim)
        for number in range(self._steps):
            self.programs += 1
            yield MaxMinStep(self.points, float(number), 5, 0.1)
        yield next(self._limits)

    def freeze(self, limit):
        self.frozen.append(limit.least)

    def release(self, limit, around=False):
        self.released.append(limit.least)
        self.released_around.append(around)
        return len(self.released) <= self._releases


def raised(raising, *given, **options):
    return walked(maximise_minimum(raising, *given, **options))


@pytest.mark.parametrize("groups", [1, 2, 3])
def test_so_many_groups_are_left_behind_and_the_first_limit_is_returned(groups):
    raising = StandIn([limit_at(0.01 * k) for k in range(1, 9)])
    steps, limit = raised(raising, 0.5, groups=groups)
    assert len(raising.asked) == groups
    assert raising.frozen == [0.01 * k for k in range(1, groups)]
    assert limit.least == 0.01
    assert [step.diagnostics for step in steps] == [{"least": -1.0}]


@pytest.mark.parametrize(("least", "frozen"), [(0.09, [0.09, 0.09]), (0.1, []), (0.11, [])])
def test_where_the_aim_is_reached_nothing_is_left_behind(least, frozen):
    raising = StandIn([limit_at(least)] * 3)
    raised(raising, 0.1, groups=3)
    assert raising.frozen == frozen


@pytest.mark.parametrize(("below", "frozen"), [(0.01, [0.01, 0.02]), (0.015, []), (0.5, [])])
def test_it_gives_up_where_the_first_group_is_stuck_too_low(below, frozen):
    raising = StandIn([limit_at(0.01 * k) for k in range(1, 9)])
    _, limit = raised(raising, 0.5, groups=3, give_up_below=below)
    assert raising.frozen == frozen
    assert limit.least == 0.01


def test_nothing_follows_where_nothing_limits():
    raising = StandIn([limit_at(-1.0, 0)])
    assert raised(raising, 0.5, 0.5, groups=5)[1].least == -1.0
    assert raising.frozen == raising.released == []


def test_nodes_are_released_below_a_value_as_often_as_there_are_any_before_a_group_is_left_behind():
    raising = StandIn([limit_at(least) for least in (0.0, 0.05, 0.09, 0.1, 0.15)], releases=2)
    raised(raising, 0.5, 0.1, groups=3)
    assert raising.released == [0.0, 0.05, 0.09]
    assert raising.frozen == [0.09, 0.1]


def test_where_releases_bring_nothing_nodes_around_follow():
    raising = StandIn([limit_at(least) for least in (0.01, 0.05, 0.05, 0.0501, 0.0502, 0.06, 0.2)], releases=6)
    raised(raising, 0.15, 0.1, groups=1)
    assert raising.released_around == [False, False, False, False, True, False]


@pytest.mark.parametrize("infeasible", [False, True])
def test_every_third_step_is_shown_and_says_that_more_is_to_come(infeasible):
    steps, _ = raised(StandIn([limit_at(0.3)], steps=7), 0.5, infeasible=infeasible)
    assert [step.diagnostics["least"] for step in steps] == [
        -1.0,
        *map(float, range(0, 7, MAXMIN.programs_per_iteration)),
    ]
    assert all(step.intermediate and step.infeasible == infeasible for step in steps)
