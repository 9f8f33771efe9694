"""Counts of hexes in bins."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import DEFAULT_BINS, distribute
from hexmend_app.picture.visibility import Show

Q = Axis("q")
_QUALITIES = arrays(np.float64, st.integers(0, 200), elements=st.floats(0, 1))


@given(_QUALITIES, st.integers(0, 2**32 - 1))
def test_every_hex_is_counted_once(q, seed):
    inverted = np.random.default_rng(seed).random(len(q)) < 0.3
    counted = distribute(q, inverted, Q)
    assert counted.counts.sum() + counted.inverted == counted.total == len(q)
    assert counted.inverted == inverted.sum()


@pytest.mark.parametrize("bins", [10, DEFAULT_BINS, 200])
def test_bins_agree_with_numpys_histogram(bins):
    q = np.random.default_rng(0).beta(5, 2, 5000)
    counted = distribute(q, np.zeros(5000, bool), Q, bins)
    assert counted.counts.tolist() == np.histogram(q, bins, (0, 1))[0].tolist()


def test_a_quality_that_exceeds_one_by_rounding_is_counted_and_within_the_range():
    counted = distribute(np.array([1 + 2e-16, np.nextafter(1, 2)]), np.array([False, True]), Q)
    assert counted.counts[-1] == 1
    assert counted.within(Show((0.9, 1.0), "q")) == 1
    assert counted.within(Show((0.9, 1.0), "q", True)) == 2
    assert counted.within(Show((0.9, 0.99), "q")) == 0


def test_values_beyond_open_ends_are_counted_in_separate_bars():
    axis = Axis("volume", 1.0, 2.0, open_low=True, open_high=True)
    values = np.array([-np.inf, 0.999999, 1.0, 1.999999, 2.0, np.inf, np.nan])
    counted = distribute(values, np.arange(7) == 6, axis, 10)
    assert (counted.below, counted.counts.tolist(), counted.above, counted.inverted) == (2, [1, *[0] * 8, 1], 2, 1)
    assert counted.cumulated().counts.tolist() == [4] * 9 + [5]
    assert (counted.cumulated().below, counted.cumulated().above) == (3, 7)
