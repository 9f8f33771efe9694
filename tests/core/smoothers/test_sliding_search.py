"""The line search of a node that slides."""

import itertools

import numpy as np
import pytest

from hexmend.boundary import SlidingBoundary
from hexmend.smoothers import METHODS
from tests.core.boundary.solids import ball, slid


@pytest.mark.parametrize("name", ["local-sd", "local-nr", "local-mnr"])
def test_a_step_that_is_cut_once_is_tried_again(name):
    """The first step is a hundred times too long; cut once, to a hundredth, it is what it should be."""
    mesh = slid(ball(3), 0.2, 2)
    nodes = SlidingBoundary(mesh).nodes
    usual = {"boundary": "slide"}
    right, long = (
        METHODS[name](**usual, **how).steps(mesh)
        for how in (
            {"initial_step": 0.2, "max_backtracks": 1},
            {"initial_step": 20.0, "backtrack_factor": 0.01, "max_backtracks": 1},
        )
    )
    moved = []
    for steps in (right, long):
        *_, step = itertools.islice(steps, 2)
        moved.append(np.linalg.norm(step.points - mesh.points, axis=1)[nodes] > 1e-9)
    assert moved[0].mean() > 0.6
    assert moved[1].mean() > 0.6
