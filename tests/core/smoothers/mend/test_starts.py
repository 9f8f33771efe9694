"""Choice between two starts, on stand-ins whose least values are given step by step."""

from types import SimpleNamespace

import numpy as np
import pytest

from hexmend.iteration import Step
from hexmend.smoothers.mend.surface.starts import improve_within_reach, raise_from_better, while_promising
from tests.core.grids import grid
from tests.core.smoothers.mend.walks import walked


def optimiser(least):
    return SimpleNamespace(corners=SimpleNamespace(movable_minimum=least))


def chosen(promising, reached, trial=10):
    """The result, and the number of steps from each start, of optimisers that take over their last value at the end."""
    starts = [optimiser(values[0]) for values in (promising, reached)]
    taken = {id(start): 0 for start in starts}

    def raise_least(start):
        for value in promising[1:] if start is starts[0] else reached[1:]:
            taken[id(start)] += 1
            yield Step(np.zeros((8, 3)), {"least": value})
        start.corners.movable_minimum = (promising if start is starts[0] else reached)[-1]
        return None

    _, result = walked(raise_from_better(*starts, raise_least, trial))
    return starts.index(result.optimiser), [taken[id(start)] for start in starts]


def test_a_start_that_overtakes_the_other_on_its_way_goes_on_though_its_optimiser_has_not_moved_yet():
    assert chosen([0.1, 0.2, 0.3, 0.35, 0.4, 0.42], [0.25, 0.5]) == (0, [5, 0])


def test_a_start_whose_last_gains_do_not_lead_to_the_other_is_left_at_once():
    rising = [0.1, 0.11, 0.12, 0.121, 0.122, 0.123, 0.124, 0.125, 0.126, 0.127, 0.128, 0.129]
    assert chosen(rising, [0.4, 0.5]) == (1, [2, 1])


def test_a_start_that_comes_nearer_has_all_iterations():
    rising = [0.1, *(0.1 + 0.03 * np.arange(1, 14))]
    assert chosen(rising, [0.35, 0.5]) == (0, [13, 0])
    assert chosen(rising, [0.35, 0.5], trial=6) == (1, [4, 1])


@pytest.mark.parametrize("end", [0.2, 0.3])
def test_a_start_that_falls_again_ends_no_lower_than_the_other(end):
    which, _ = chosen([0.1, 0.2, 0.4, end], [0.3, 0.35])
    assert which == (0 if end >= 0.3 else 1)


def test_without_a_second_start_the_first_goes_to_its_end():
    start = optimiser(0.1)

    def raise_least(_):
        yield from (Step(np.zeros((8, 3)), {"least": 0.1}) for _ in range(20))
        return None

    steps, result = walked(raise_from_better(start, None, raise_least, 3))
    assert len(steps) == 20
    assert result.optimiser is start


@pytest.mark.parametrize(
    ("heights", "taken", "result"),
    [
        ([0.5, 0.5, 0.9, 0.5, 0.5, 0.5, 1.0], 6, None),  # lower three times on end
        ([0.5, 0.5, 0.9, 0.5, 0.5, 0.9, 0.5], 7, "end"),
        ([0.9, 0.5], 2, "end"),
    ],
)
def test_steps_towards_a_start_end_where_their_least_stays_lower_than_at_another(heights, taken, result):
    mesh = grid(2)
    middle = int(np.flatnonzero(mesh.free)[0])

    def points_at(height):
        points = mesh.points.copy()
        points[middle, 2] = height  # 1 makes cubes
        return points

    def towards_a_start():
        yield from (Step(points_at(height)) for height in heights)
        return "end"

    steps, found = walked(while_promising(towards_a_start(), mesh, [points_at(0.3), points_at(0.7)], 3))
    assert (len(steps), found) == (taken, result)


@pytest.mark.parametrize(
    ("rising", "taken"),
    [
        ([0.05, 0.06, 0.07, 0.08, 0.09], 4),  # 0.01 a step do not lead to 0.2 in ten steps
        ([0.05, 0.07, 0.09, 0.11, 0.13, 0.15], None),
        ([0.05, 0.21, 0.21, 0.21, 0.21, 0.21], None),  # reached: no prospect is asked for any more
    ],
)
def test_points_are_improved_to_the_end_or_until_the_least_is_out_of_reach(rising, taken):
    improved = []
    points = [np.full((8, 3), value) for value in rising]

    def steps():
        for of, value in zip(points, rising, strict=True):
            yield Step(of, {"least": value})
        return np.full((8, 3), 9.0)

    shown, ended = walked(improve_within_reach(SimpleNamespace(improve_to=improved.append), steps(), 0.2, 10))
    assert ended == (taken is None)
    assert len(shown) == (taken or len(rising))
    assert [of[0, 0] for of in improved] == [9.0 if ended else rising[taken - 1]]
