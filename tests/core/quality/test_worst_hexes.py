"""Order of the worst hexes."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.quality import ElementQuality, rank_worst
from hexmend.quality.validity import Validity


@given(st.integers(0, 2**32 - 1), st.integers(0, 40), st.sampled_from([1, -1]))
def test_the_worst_are_inverted_then_invalid_inside_then_the_lowest(seed, count, better):
    random = np.random.default_rng(seed)
    values, jacobian = random.integers(0, 6, (2, 30)) / 5.0
    sigma = random.choice([-1.0, 1.0], 30, p=[0.3, 0.7])
    inside = np.where(random.random(30) < 0.2, Validity.INVALID_INSIDE, Validity.VALID)
    validity = np.where(sigma <= 0, Validity.INVERTED, inside).astype(np.uint8)
    figures = ElementQuality(values, sigma, jacobian, values, validity)
    got = rank_worst(values, figures, count, better)
    order = [Validity.INVERTED, Validity.INVALID_INSIDE, Validity.VALID]
    everything = sorted(range(30), key=lambda h: (order.index(validity[h]), better * values[h], jacobian[h], h))
    assert got.tolist() == everything[:count]


def test_what_has_no_value_is_the_worst_whichever_way_is_better():
    values = np.array([0.5, np.nan, 3.0, np.inf])
    figures = ElementQuality(values, np.ones(4), np.zeros(4), values, np.zeros(4, np.uint8))
    assert rank_worst(values, figures, 4).tolist() == [1, 0, 2, 3]
    assert rank_worst(values, figures, 3, better=-1).tolist() == [1, 3, 2]
    assert np.isnan(values[1])  # not written into


@pytest.mark.parametrize("count", [0, 1, 7, 100, 2_999, 3_000, 4_000])
@pytest.mark.parametrize("levels", [2, 40, 10**9])
def test_of_many_hexes_the_worst_are_found_without_sorting_all(count, levels):
    random = np.random.default_rng(count)
    q, scaled = (random.integers(0, levels, 3_000) / levels for _ in range(2))
    order = np.lexsort((np.arange(3_000), scaled, q))
    valid = np.zeros(3_000, bool)
    figures = SimpleNamespace(q=q, scaled_jacobian=scaled, inverted=valid, invalid=valid)
    assert rank_worst(q, figures, count).tolist() == order[:count].tolist()
