"""Limits of a moving boundary: tolerances of its fit to the surface, steps through them, and room."""

import numpy as np
import pytest

from tests.core.energy.fits import TOLERANCE, fit_of, moved, on_top
from tests.core.grids import grid


@pytest.fixture(scope="module")
def block():
    """A block with the number of a node in the middle of its top."""
    fit, energy, x = fit_of(grid(4))
    return fit, energy, x, int(np.flatnonzero(on_top(x) & (x[:, :2] == 2).all(axis=1))[0])


def test_a_barrier_is_infinite_beyond_a_tolerance_and_a_ceiling_is_not(block):
    fit, _, x, node = block
    for height in (1.001 * TOLERANCE, 3 * TOLERANCE):
        there = moved(x, node, [0, 0, height])
        assert fit.with_weights(weight=1.0).value(there) == np.inf
        assert np.isfinite(fit.with_weights(slope=1.0).value(there))
    assert np.isfinite(fit.with_weights(weight=1.0).value(moved(x, node, [0, 0, 0.999 * TOLERANCE])))
    assert fit.with_weights(weight=1.0, slope=1.0).value(x) == pytest.approx(0, abs=1e-12)


def test_steps_through_the_tolerance_are_marked(block):
    fit, energy, x, node = block
    fit = fit.with_weights(weight=1.0)
    marks = fit.beyond(x, moved(x, node, [0, 0, 1.5 * TOLERANCE]))
    np.testing.assert_array_equal(np.flatnonzero(marks), node)
    np.testing.assert_array_equal(energy.with_surface(fit).infeasible_nodes(x, moved(x, node, [0, 0, 0.3])), marks)
    assert fit.beyond(x, moved(x, node, [0, 0, 0.5 * TOLERANCE])) is None
    assert fit.beyond(x, moved(x, node, [0.4, 0.3, 0])) is None
    assert fit.with_weights(slope=1.0).beyond(x, moved(x, node, [0, 0, 1.5 * TOLERANCE])) is None


def test_room_is_made_for_positions_outside(block):
    fit, _, x, node = block
    for height in (1.1, 1.5, 3):
        there = moved(x, node, [0, 0, height * TOLERANCE])
        assert not fit.is_within(there)
        wider = fit.with_weights(weight=1.0).allowing(there, np.full_like(fit.diagonal, True))
        assert wider.is_within(there, 1 + 1e-12)
        assert np.isfinite(wider.value(there))
        assert (wider.tolerances >= fit.tolerances).all()
        same = fit.allowing(there, np.full_like(fit.diagonal, False))
        np.testing.assert_array_equal(same.tolerances, fit.tolerances)


def test_within_is_allowing_to_the_tolerance_or_a_multiple_of_it(block):
    fit, _, x, node = block
    assert fit.is_within(moved(x, node, [0, 0, 0.94 * TOLERANCE]))
    assert not fit.is_within(moved(x, node, [0, 0, 0.96 * TOLERANCE]))
    assert fit.is_within(moved(x, node, [0, 0, 1.8 * TOLERANCE]), 2.0)
    assert not fit.is_within(moved(x, node, [0, 0, 2.0 * TOLERANCE]), 2.0)
