"""Cost of a sweep over nodes that have converged."""

import itertools

import pytest

from hexmend.smoothers import METHODS
from tests.core.boundary.solids import ball, slid
from tests.core.grids import scrambled


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
@pytest.mark.parametrize("name", ["local-nr", "local-mnr", "local-patch"])
def test_a_converged_node_costs_one_evaluation_a_sweep(name, boundary):
    """Its line search gives up after the first trial, since rounding hides the descent of any further one."""
    mesh = slid(ball(3), 0.2, 2) if boundary == "slide" else scrambled(ball(3), 0.3, 1)
    *_, last = itertools.islice(METHODS[name](boundary=boundary).steps(mesh), 100)
    assert 0 < last.diagnostics["energy_evaluations"] <= last.diagnostics["derivative_evaluations"]
