"""Arrays that do not change, and sums over long ones that are the same with any number of threads."""

from __future__ import annotations

import numpy as np


class _Memory:
    """Memory of an array that only this object refers to, given out for reading alone.

    NumPy refuses to make an array writable whose memory is of an object that is neither an array nor a buffer. An array
    that owns its memory, or has it from `bytes`, proves nothing: it may have been writable before, and views made then
    still are.
    """

    __slots__ = ("__array_interface__", "_owner")

    def __init__(self, owner: np.ndarray):
        self._owner = owner
        self.__array_interface__ = owner.__array_interface__ | {"data": (owner.ctypes.data, True)}


def is_immutable(array: np.ndarray) -> bool:
    """True for an array that `as_immutable` made and for views of it: nobody can write to them, now or later.

    >>> values = np.zeros(2)
    >>> is_immutable(values), is_immutable(as_immutable(values))
    (False, True)
    """
    owner: object = array
    while isinstance(owner, np.ndarray):
        owner = owner.base
    return type(owner) is _Memory


def as_immutable(array: np.ndarray) -> np.ndarray:
    """The array if it is immutable, otherwise a contiguous copy that is; the given array stays as it is.

    Copies of arrays of Python objects are read-only, but never count as immutable.
    """
    if is_immutable(array):
        return array
    copy = np.array(array, order="C", copy=True, subok=False)
    if not copy.dtype.hasobject:
        return np.asarray(_Memory(copy))
    copy.flags.writeable = False
    return copy


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
