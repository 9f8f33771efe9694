"""Which band is kept where nodes have left the surface, on stand-ins whose least values are given."""

from types import SimpleNamespace

import numpy as np
import pytest

from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.stages import Stages
from hexmend.smoothers.mend.surface.detours import MaxMinResult
from tests.core.smoothers.mend.walks import walked

BAND, TOLERANCE = 0.1, 0.3


def result(least, band=BAND, released=True):
    def limit_to(width):
        envelope.max_deviation = width

    envelope = SimpleNamespace(released=np.array([released]), max_deviation=band, limit_to=limit_to)
    corners = SimpleNamespace(movable_minimum=least)
    optimiser = SimpleNamespace(points=np.zeros((8, 3)), corners=corners, envelope=envelope)
    optimiser.fork = lambda: result(least, envelope.max_deviation, released).optimiser
    return MaxMinResult(optimiser, None)


def chosen(given, by_band, only_wider=False):
    """The result of raising from a given one, the bands in which that was tried, and the steps."""
    tried = []

    def along_path(leaving, start):
        tried.append(start.optimiser.envelope.max_deviation)
        return None if by_band[tried[-1]] is None else result(by_band[tried[-1]], tried[-1])
        yield

    stages = Stages(Mend(goal="scaled-jacobian", boundary="slide"))
    stages._raise_along_path = along_path  # noqa: SLF001
    steps, found = walked(stages._raise_released(None, given, TOLERANCE, only_wider))  # noqa: SLF001
    return found, tried, steps


@pytest.mark.parametrize(
    ("wide", "narrow", "least", "bands"),
    [
        (0.501, 0.45, 0.501, [TOLERANCE]),  # a quarter is gained in the whole tolerance
        (0.499, 0.45, 0.45, [TOLERANCE, BAND]),  # less is: the boundary stays nearer
        (None, 0.45, 0.45, [TOLERANCE, BAND]),
        (0.49, 0.39, 0.4, [TOLERANCE, BAND]),
        (0.49, None, 0.4, [TOLERANCE, BAND]),
    ],
)
def test_the_whole_tolerance_is_used_where_that_gains_a_quarter(wide, narrow, least, bands):
    given = result(0.4)
    found, tried, steps = chosen(given, {TOLERANCE: wide, BAND: narrow})
    assert found.least == least
    assert tried == bands
    assert given.optimiser.envelope.max_deviation == BAND
    assert [step.diagnostics["least"] for step in steps] == [least] * (found is not given)


def test_the_band_in_which_the_least_was_raised_already_is_not_tried_again():
    assert chosen(result(0.4), {TOLERANCE: 0.45}, only_wider=True)[1] == [TOLERANCE]


@pytest.mark.parametrize("given", [result(0.4, released=False), result(-0.1)])
def test_nothing_is_raised_where_no_node_has_left_or_a_hex_is_inverted(given):
    found, tried, _ = chosen(given, {})
    assert found is given
    assert not tried
