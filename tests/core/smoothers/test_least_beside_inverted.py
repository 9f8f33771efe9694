"""A run never ends with more invalid hexes, and mend with a lower least scaled Jacobian while hexes stay inverted."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers import METHODS
from tests.core.grids import grid, scrambled

GOALS = ("balanced", "shape", "scaled-jacobian", "time-step")


def pinned_tangle(seed):
    """Make a tangled grid of 27 hexes with half of its inner nodes pinned, so that no method makes all hexes valid."""
    mesh = scrambled(grid(3), 1.0, seed)
    return mesh.replace(pinned=mesh.free & (np.random.default_rng(seed).random(mesh.n_nodes) < 0.5))


@pytest.mark.parametrize("seed", [3, 7])  # one with a locked hex, one without
@pytest.mark.parametrize(
    ("method", "options"),
    [*((name, {}) for name in METHODS if name != "mend"), *(("mend", {"goal": goal}) for goal in GOALS)],
)
def test_no_more_hexes_are_invalid_and_the_least_of_mend_is_not_lower(method, options, seed):
    result = hx.smooth(pinned_tangle(seed), method, max_iterations=40, **options)
    assert result.after.inverted > 0
    if method == "mend":
        assert result.after.scaled_jacobian_min >= result.before.scaled_jacobian_min - WORSE_BY
    assert result.after.invalid <= result.before.invalid
