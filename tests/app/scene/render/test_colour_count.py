"""Counts of colours, compared with those of rows."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend_app.scene.render.colour_count import count_colours


@given(
    arrays(np.uint8, st.tuples(st.integers(0, 9), st.integers(1, 9), st.just(3)), elements=st.sampled_from([0, 1, 255]))
)
def test_counts_agree_with_those_of_unique_rows(pixels):
    colours, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    found = count_colours(pixels)
    np.testing.assert_array_equal(found[0], colours)
    np.testing.assert_array_equal(found[1], counts)
