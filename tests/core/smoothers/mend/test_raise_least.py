"""How groups of corners that hold each other are left behind, on a stand-in that only says where it ends."""

from types import SimpleNamespace

import numpy as np
import pytest

from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinStep
from hexmend.smoothers.mend.maxmin_stage import TOGETHER, raise_least

NOTHING = np.empty(0, np.int64)


def limit_at(least, hexes=1):
    return ActiveCorners(least, np.arange(hexes), np.zeros(hexes, np.int64))


class StandIn:
    """Makes some steps, then ends at the next of some limits; records what is done about each."""

    def __init__(self, limits, steps=0, lifts=0):
        self.points, self.corners = np.zeros((8, 3)), SimpleNamespace(least=-1.0)
        self._limits, self._steps, self._lifts = iter(limits), steps, lifts
        self.asked, self.settled, self.lifted = [], [], []

    def steps(self, aim):
        self.asked.append(aim)
        for number in range(self._steps):
            yield MaxMinStep(self.points, float(number), 5, 0.1)
        yield next(self._limits)

    def freeze(self, limit):
        self.settled.append(limit.least)

    def release(self, limit):
        self.lifted.append(limit.least)
        return len(self.lifted) <= self._lifts


def walked(raising, *given, **options):
    steps, walk = [], raise_least(raising, *given, **options)
    while True:
        try:
            steps.append(next(walk))
        except StopIteration as end:
            return steps, end.value


@pytest.mark.parametrize("clusters", [1, 2, 3])
def test_so_many_groups_are_left_behind_and_the_first_limit_is_returned(clusters):
    raising = StandIn([limit_at(0.01 * k) for k in range(1, 9)])
    steps, limit = walked(raising, 0.5, clusters=clusters)
    assert len(raising.asked) == clusters
    assert raising.settled == [0.01 * k for k in range(1, clusters)]
    assert limit.least == 0.01
    assert [step.diagnostics for step in steps] == [{"least": -1.0}]


@pytest.mark.parametrize(("least", "settled"), [(0.09, [0.09, 0.09]), (0.1, []), (0.11, [])])
def test_where_the_aim_is_reached_nothing_is_left_behind(least, settled):
    raising = StandIn([limit_at(least)] * 3)
    walked(raising, 0.1, clusters=3)
    assert raising.settled == settled


def test_nothing_follows_where_nothing_limits():
    raising = StandIn([limit_at(-1.0, 0)])
    assert walked(raising, 0.5, 0.5, clusters=5)[1].least == -1.0
    assert raising.settled == raising.lifted == []


def test_nodes_are_lifted_below_a_value_as_often_as_there_are_any_before_a_group_is_left_behind():
    raising = StandIn([limit_at(least) for least in (0.0, 0.05, 0.09, 0.1, 0.15)], lifts=2)
    walked(raising, 0.5, 0.1, clusters=3)
    assert raising.lifted == [0.0, 0.05, 0.09]
    assert raising.settled == [0.09, 0.1]


@pytest.mark.parametrize("infeasible", [False, True])
def test_every_third_step_is_shown_and_says_that_more_is_to_come(infeasible):
    steps, _ = walked(StandIn([limit_at(0.3)], steps=7), 0.5, infeasible=infeasible)
    assert [step.diagnostics["least"] for step in steps] == [-1.0, *map(float, range(0, 7, TOGETHER))]
    assert all(step.intermediate and step.infeasible == infeasible for step in steps)
