"""Rows of arrays that others name by their numbers."""

import numpy as np
import pytest

from hexmend.kernels import rows


@pytest.mark.parametrize("width", [4, 8])
def test_rows_with_a_marked_number_are_found(width):
    rng = np.random.default_rng(width)
    marks, numbers = rng.random(500) < 0.1, rng.integers(0, 500, (20_000, width)).astype(np.int32)
    found = np.empty(len(numbers), dtype=bool)
    rows.any_marked(marks, numbers, found)
    np.testing.assert_array_equal(found, marks[numbers].any(axis=1))


def test_rows_are_written_and_scaled_and_others_stay():
    rng = np.random.default_rng(1)
    points, numbers, values = (
        rng.normal(size=(50, 3)),
        rng.permutation(50)[:20].astype(np.int32),
        rng.normal(size=(20, 3)),
    )
    expected, scaled = points.copy(), points.copy()
    expected[numbers] = values
    scaled[numbers] *= values
    written, multiplied = points.copy(), points.copy()
    rows.put_rows(values, numbers, written)
    rows.scale_rows(values, numbers, multiplied)
    np.testing.assert_array_equal(written, expected)
    np.testing.assert_array_equal(multiplied, scaled)
