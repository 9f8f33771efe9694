"""What methods advise where something got worse, and what mend's steps say while another stage is to come."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from hexmend.boundary import SlidingBoundary
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.quality.regressions import REGRESSION_KEYS
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.maxmin import MAXMIN
from hexmend.smoothers.mend.surface.detours import MaxMinResult, improve_off_surface
from tests.core.boundary.solids import ball, slid
from tests.core.smoothers.mend.walks import walked

#: Every set of figures that can be worse.
WORSE = [words for count in range(len(REGRESSION_KEYS) + 1) for words in itertools.combinations(REGRESSION_KEYS, count)]


@pytest.mark.parametrize("name", METHODS)
def test_what_is_advised_is_a_text_whatever_got_worse(name):
    assert all(isinstance(METHODS[name]().regression_hint(words), str) for words in WORSE)


def test_mend_advises_its_other_goal_or_its_guard_only_where_they_help():
    mend = METHODS["mend"]
    for words in WORSE:
        advice = mend(goal="shape").regression_hint(words)
        valid = not {"inverted", "invalid"} & set(words)
        assert ("goal=scaled-jacobian" in advice) == ("scaled_jacobian" in words and valid)
        assert ("guard=true" in advice) == (bool(words) and valid)
        assert mend(goal="scaled-jacobian").regression_hint(words) == mend().regression_hint(words) == ""


def test_what_is_no_better_off_the_surface_is_given_up():
    mesh = ball(3)
    sliding = SlidingBoundary(mesh, max_deviation=1e-9)
    other = MaxMinOptimiser(sliding.mesh, mesh.points, sliding)
    *_, limit = other.steps()
    other.corners.values[:] = 1.0  # as good as can be: nothing is better
    walk = improve_off_surface(
        [MaxMinOptimiser(sliding.mesh, mesh.points, sliding)], [1e-9], MaxMinResult(other, limit), 0.2
    )
    steps, result = walked(walk)
    assert result.optimiser is other
    assert result.active is limit
    assert steps[-1].points is other.points
    assert steps[-1].diagnostics == {"least": other.corners.movable_minimum}
    assert all(step.intermediate for step in steps)


def test_what_is_better_off_the_surface_and_back_in_its_band_is_taken():
    mesh = slid(ball(3), 0.3, 1)
    room = 0.1 * mesh.mean_edge_length
    sliding = SlidingBoundary(mesh, max_deviation=room)
    other, off = (MaxMinOptimiser(sliding.mesh, mesh.points, sliding) for _ in range(2))
    limit = ActiveCorners(other.corners.active_minimum, np.array([0]), np.array([0]))
    walk = improve_off_surface([off], [room], MaxMinResult(other, limit), 0.2, replace(MAXMIN, acceptable=0.3))
    _, result = walked(walk)
    assert result.optimiser is off
    assert result.active is not limit
    assert off.corners.movable_minimum > other.corners.movable_minimum
    assert 0.5 * room < off.envelope.largest_deviation(off.points) <= room * (1 + 1e-5)
    assert not off.envelope.flips_allowed
