"""Arrays that do not change, and sums over long ones that are the same with any number of threads."""

from __future__ import annotations

import numpy as np


def immutable(array: np.ndarray) -> bool:
    """True where nobody can write to an array: neither it nor any array that it is a view of is writable.

    >>> values = np.zeros(2)
    >>> immutable(values), immutable(frozen(values))
    (False, True)
    """
    owner: object = array
    while isinstance(owner, np.ndarray):
        if owner.flags.writeable:
            return False
        owner = owner.base
    return owner is None or isinstance(owner, bytes)


def frozen(array: np.ndarray) -> np.ndarray:
    """The array if it is immutable, otherwise a contiguous read-only copy of it; the given array stays as it is."""
    if immutable(array):
        return array
    copy = np.array(array, order="C", copy=True)
    copy.flags.writeable = False
    return copy


def freeze(array: np.ndarray) -> np.ndarray:
    """The array made read-only in place, for one that the caller has made and gives up; of a view a read-only copy."""
    if array.base is None:
        array.flags.writeable = False
    return frozen(array)


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
