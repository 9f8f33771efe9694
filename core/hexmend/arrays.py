"""Arrays as kernels take them, and sums over long ones that are the same with any number of threads."""

from __future__ import annotations

import numpy as np


def as_points(points: np.ndarray) -> np.ndarray:
    """(n, 3) float64, contiguous; the same array where it is that already."""
    return np.ascontiguousarray(points, np.float64)


def as_hexes(hexes: np.ndarray) -> np.ndarray:
    """(m, 8) int32, contiguous; the same array where it is that already."""
    return np.ascontiguousarray(hexes, np.int32)


def read_only(array: np.ndarray) -> np.ndarray:
    """A read-only view of an array of any shape, for positions that are handed out and never changed afterwards."""
    view = array.view()
    view.flags.writeable = False
    return view


def dot(a: np.ndarray, b: np.ndarray) -> float:
    """Inner product of two arrays of one shape.

    Not by BLAS, which shares out vectors of 10,000 numbers already: its sums depend on the number of its threads, and
    these wait by spinning, on cores that the kernels want.

    >>> dot(np.ones((2, 3)), np.full((2, 3), 0.5))
    3.0
    """
    return float(np.einsum("i,i->", np.ravel(a), np.ravel(b)))


def norm(a: np.ndarray) -> float:
    """Euclidean length of an array of any shape; see `dot`."""
    return float(np.sqrt(dot(a, a)))
