"""Barrier of the Bernstein coefficients of det J: its gradient by differences, its floors, and what these certify."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import ObjectiveNorm
from hexmend.energy.barriers.validity_barrier import ValidityBarrier
from hexmend.quality.validity import Validity, certify
from tests.core.grids import grid, scrambled

NORM = ObjectiveNorm()
seeds = st.integers(0, 2**32 - 1)


def case_of(seed, amplitude=0.4):
    """A barrier of some hexes of a grid, with values in its band, and positions."""
    mesh = scrambled(grid(3), amplitude, seed)
    return ValidityBarrier.of(mesh.hexes[::4].copy(), mesh.points, 0.1, 1.0), mesh.points


@given(seeds)
def test_its_gradient_is_that_of_differences(seed):
    barrier, x = case_of(seed)
    way = np.random.default_rng(seed).normal(size=x.shape)
    step = 1e-6
    rise = (barrier.value(x + step * way, NORM) - barrier.value(x - step * way, NORM)) / (2 * step)
    gradient = barrier.gradient(x, NORM)
    scale = np.abs(gradient * way).sum()
    assert np.isfinite(rise)
    assert (gradient * way).sum() == pytest.approx(rise, abs=1e-5 * max(scale, 1))


@given(seeds, st.floats(0.01, 0.9))
def test_floors_never_fall_and_stay_below_the_coefficients(seed, gap):
    barrier, x = case_of(seed)
    for _ in range(3):
        higher = barrier.with_higher_floors(x, gap)
        assert (higher.floors >= barrier.floors).all()
        assert higher.deficit <= barrier.deficit
        assert np.isfinite(higher.value(x, NORM))
        barrier, x = higher, x + np.random.default_rng(seed).uniform(-1e-3, 1e-3, x.shape)
        if not np.isfinite(barrier.value(x, NORM)):
            return


@given(seeds)
def test_hexes_are_valid_where_the_barrier_is_finite_over_floors_that_are_not_negative(seed):
    barrier, x = case_of(seed, 0.25)
    barrier = barrier.with_higher_floors(x, 0.25)
    valid = certify(x, barrier.hexes) == Validity.VALID
    assert valid[barrier.floors >= 0].all()
    assert (barrier.floors >= 0).any()
