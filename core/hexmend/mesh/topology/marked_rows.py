"""Faces, hexes and other rows of nodes with at least one marked node."""

from __future__ import annotations

import numpy as np


def any_of_rows(marks: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mark rows (k, w) of numbers with at least one number marked in `marks` (n,) bool, (k,) bool.

    >>> any_of_rows(np.array([True, False, False]), np.array([[1, 2], [2, 0]])).tolist()
    [False, True]
    """
    found = marks.take(rows[:, 0])  # in half the time of marks[...]
    for column in range(1, rows.shape[1]):
        found |= marks.take(rows[:, column])
    return found
