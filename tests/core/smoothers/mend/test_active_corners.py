"""What lets the minimum scaled Jacobian rise no further, in sentences and as arrays, for every count of corners."""

from types import SimpleNamespace

import numpy as np
import pytest

from hexmend.optimise.maxmin.corner_measure import SCALED_JACOBIAN
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.smoothers.mend.maxmin import active_set
from hexmend.smoothers.mend.messages import limit_message
from tests.core.grids import grid

BEGIN = "The minimum scaled Jacobian of the corners that can be moved is 0.2500: "


def stand_in(places=(), locked=()):
    """What has raised the least: each corner of the limit is in one of some places, some lower ones are locked."""
    values = np.full((27, 8), 0.5)
    values.ravel()[list(locked)] = -0.125
    asked = []
    corners = SimpleNamespace(
        measure=SCALED_JACOBIAN,
        values=values,
        groups=lambda _: np.array(places),
        locked_below=lambda value: asked.append(value) or np.array(locked, np.int64),
    )
    return SimpleNamespace(mesh=grid(3), corners=corners, asked=asked)


def limit_of(*hexes):
    return ActiveCorners(0.25, np.array(hexes, np.int64), np.arange(len(hexes)))


def test_nothing_is_said_where_nothing_limits():
    assert limit_message(stand_in(), limit_of()) == ""


@pytest.mark.parametrize(
    ("hexes", "places", "said"),
    [
        ([7], [0], "it cannot be raised further, in hex 7."),
        ([7, 5], [0, 0], "2 of them limit each other there, in the hexes 7, 5."),
        ([7, 5, 7], [0, 0, 0], "3 of them limit each other there, in the hexes 7, 5."),
        ([7, 5, 2], [0, 1, 0], "it is limited by 3 corners at 2 separate places, in the hexes 7, 5, 2."),
        (range(10), range(10), "it is limited by 10 corners at 10 separate places, in the hexes 0, 1, 2, 3, 4, 5, "
         "6, 7."),
    ],
)  # fmt: skip
def test_corners_of_a_limit_are_said_by_place(hexes, places, said):
    assert limit_message(stand_in(list(places)), limit_of(*hexes)) == BEGIN + said


@pytest.mark.parametrize(
    ("locked", "said"),
    [
        ([19], " One corner is locked below that: -0.1250 at the lowest, in hex 2."),
        ([19, 40], " 2 corners are locked below that: -0.1250 at the lowest, in hex 2."),
    ],
)
def test_corners_that_are_locked_below_it_are_counted(locked, said):
    assert limit_message(stand_in([0], locked), limit_of(7)).endswith("in hex 7." + said)


def test_the_limits_name_hexes_nodes_and_each_locked_hex_once():
    raising = stand_in([0, 0], [40, 19, 41])
    limits = active_set(raising, limit_of(3, 9))
    assert limits.hexes.tolist() == [3, 9]
    assert limits.nodes.tolist() == [raising.mesh.hexes[3, 0], raising.mesh.hexes[9, 1]]
    assert limits.locked.tolist() == [5, 2]
    assert raising.asked == [0.25]
    active_set(raising, limit_of())
    assert raising.asked[-1] == -np.inf
