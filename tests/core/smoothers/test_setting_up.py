"""What methods prepare before their first step, and how they end where there is nothing to gain."""

import numpy as np
import pytest

from hexmend.smoothers import METHODS
from hexmend.smoothers.local import single_node
from tests.core.grids import grid, scrambled


def test_the_order_of_visits_is_worked_out_before_the_first_step(monkeypatch):
    """So that it counts as set-up, and every sweep takes the same time."""
    asked = []

    class Visits(single_node.VisitOrder):
        def groups(self, points, sweep):
            asked.append(sweep)
            return super().groups(points, sweep)

    monkeypatch.setattr(single_node, "VisitOrder", Visits)
    steps = METHODS["local-sd"]().steps(scrambled(grid(3), 0.2))
    next(steps)
    assert asked == [0]
    next(steps), next(steps)
    assert asked == [0, 0, 1]


@pytest.mark.parametrize("exponent", [0.0, 1.0, 3.0])
def test_weights_of_getme_are_those_of_the_paper_and_never_nothing(exponent):
    q = np.array([0.0, 0.19, 0.75, 1.0])
    weigh = METHODS["getme"](weights="paper", exponent=exponent).hex_weights
    np.testing.assert_allclose(weigh(q)[:3], (1 - q[:3]) ** (exponent / 2))
    assert (weigh(q) > 0).all()
    np.testing.assert_allclose(METHODS["getme"]().hex_weights(q), [10, 0.19**-0.5, 0.75**-0.5, 1])
    assert METHODS["getme"](weights="equal").hex_weights(q).tolist() == [1, 1, 1, 1]
