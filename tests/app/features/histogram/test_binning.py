"""Values by bins, against plain NumPy."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend.kernels import binning


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.booleans(), st.booleans())
def test_every_value_is_counted_once_where_it_belongs(seed, bins, open_low, open_high):
    random = np.random.default_rng(seed)
    low, high = -0.5, 2.0
    values = np.concatenate([random.uniform(-1, 3, 200), [low, high, np.inf, -np.inf, np.nan]])
    inverted = random.random(values.size) < 0.2
    place = (values - low) * (bins / (high - low))
    none = inverted | np.isnan(place)
    at = np.floor(np.clip(place, -1, bins)[~none]).astype(int)
    at[at < 0] = bins + 1 if open_low else 0
    at[place[~none] >= bins] = bins if open_high else bins - 1
    expected = np.bincount(at, minlength=bins + 3)
    expected[bins + 2] = none.sum()
    counts = np.empty(bins + 3, dtype=np.int64)
    binning.count(values, inverted, low, bins / (high - low), open_low, open_high, counts)
    assert counts.tolist() == expected.tolist()
    assert counts.sum() == values.size
