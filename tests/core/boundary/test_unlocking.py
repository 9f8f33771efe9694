"""Locked hexes that sliding can free."""

import numpy as np
import pytest

from hexmend.boundary import boundary_of, freed_by_sliding
from hexmend.quality import locked_hexes, measure
from tests.core.boundary.solids import ball, slid


@pytest.mark.parametrize("degrees", [40.0, 180.0])
def test_a_boundary_without_curves_frees_what_it_locks(degrees):
    """At 180 degrees nothing is a feature: one patch, on which all nodes slide."""
    mesh = slid(ball(3), 0.6, seed=0)
    held = locked_hexes(mesh.points, mesh.hexes, mesh.fixed, measure(mesh.points, mesh.hexes).inverted)
    assert held.any()
    freed = freed_by_sliding(mesh, held, degrees)
    assert (freed <= held).all()
    if degrees == 180.0:
        assert boundary_of(mesh, degrees).n_curves == 0
        np.testing.assert_array_equal(freed, held)
