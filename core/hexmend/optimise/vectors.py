"""Sums over long vectors, the same with any number of threads."""

from __future__ import annotations

import numpy as np


def dot(a: np.ndarray, b: np.ndarray) -> float:
    """Inner product of two arrays of one shape.

    Not by BLAS, which shares out vectors of 10,000 numbers already: its sums depend on the number of its threads, and
    these wait by spinning, on cores that the kernels want.

    >>> dot(np.ones((2, 3)), np.full((2, 3), 0.5))
    3.0
    """
    return float(np.einsum("i,i->", np.ravel(a), np.ravel(b)))


def norm(a: np.ndarray) -> float:
    """Euclidean length."""
    return float(np.sqrt(dot(a, a)))
