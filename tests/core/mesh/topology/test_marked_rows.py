"""Marks of rows, however wide and many they are."""

import numpy as np
import pytest

from hexmend.arrays import BLOCK
from hexmend.mesh.topology.marked_rows import any_of_rows


@pytest.mark.parametrize(("width", "count"), [*((width, 50) for width in range(1, 10)), (8, 0), (3, BLOCK + 1)])
def test_a_row_is_marked_if_one_of_its_numbers_is(width, count):
    random = np.random.default_rng(width)
    marks, rows = random.random(200) < 0.2, random.integers(0, 200, (count, width)).astype(np.int32)
    found = any_of_rows(marks, rows)
    assert found.dtype == bool
    np.testing.assert_array_equal(found, marks[rows].any(axis=1))
