"""Immutable arrays, marks and indices of numbers, and products that do not depend on the number of threads."""

from __future__ import annotations

import numpy as np

#: Rows of large arrays that are worked on at a time, so that temporary arrays stay small.
BLOCK = 65_536


class _Memory:
    """Owner of an array's memory that exposes it read-only.

    NumPy refuses to make an array writable if its memory belongs to an object that is neither an array nor a buffer. A
    read-only array that owns its memory is no proof: it may have been writable, and views made then still are.
    """

    __slots__ = ("__array_interface__", "_owner")

    def __init__(self, owner: np.ndarray):
        self._owner = owner
        self.__array_interface__ = owner.__array_interface__ | {"data": (owner.ctypes.data, True)}


def is_immutable(array: np.ndarray) -> bool:
    """Return True for arrays made by `as_immutable` and views of them, which can never be written to.

    >>> values = np.zeros(2)
    >>> is_immutable(values), is_immutable(as_immutable(values))
    (False, True)
    """
    owner: object = array
    while isinstance(owner, np.ndarray):
        owner = owner.base
    return type(owner) is _Memory


def as_immutable(array: np.ndarray) -> np.ndarray:
    """Return the array itself if it is immutable, else an immutable contiguous copy.

    Copies of arrays of Python objects are read-only, but do not count as immutable.
    """
    if is_immutable(array):
        return array
    copy = np.array(array, order="C", copy=True, subok=False)
    if not copy.dtype.hasobject:
        return np.asarray(_Memory(copy))
    copy.flags.writeable = False
    return copy


def as_immutable_owned(array: np.ndarray) -> np.ndarray:
    """Return an array that nobody else holds as an immutable one, without a copy if it is contiguous.

    >>> is_immutable(as_immutable_owned(np.zeros(2)))
    True
    """
    if is_immutable(array) or not array.flags.c_contiguous or array.dtype.hasobject:
        return as_immutable(array)
    return np.asarray(_Memory(array))


def dot(a: np.ndarray, b: np.ndarray) -> float:
    """Compute the inner product of two arrays of one shape.

    BLAS is avoided: it uses threads for vectors of 10,000 numbers already, so that its sums depend on their number, and
    its idle threads spin on cores that the kernels need.

    >>> dot(np.ones((2, 3)), np.full((2, 3), 0.5))
    3.0
    """
    return float(np.einsum("i,i->", np.ravel(a), np.ravel(b)))


def euclidean_norm(a: np.ndarray) -> float:
    """Compute the Euclidean norm of an array of any shape; see `dot`."""
    return float(np.sqrt(dot(a, a)))


def largest_norm(vectors: np.ndarray) -> float:
    """Compute the norm of the longest of some vectors (n, 3); 0 of none.

    >>> largest_norm(np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 1.0]]))
    5.0
    """
    largest = 0.0
    for first in range(0, len(vectors), BLOCK):
        squares = np.square(vectors[first : first + BLOCK])
        sums = squares[:, 0] + squares[:, 1]  # by columns: NumPy's sum along rows of three takes ten times as long
        sums += squares[:, 2]
        largest = np.maximum(largest, sums.max(initial=0.0))  # which keeps what is not a number
    return float(np.sqrt(largest))


def row_norms(vectors: np.ndarray) -> np.ndarray:
    """Compute the norms of vectors (..., 3), (...), faster than `np.linalg.norm` does for such short rows.

    >>> row_norms(np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 1.0]])).tolist()
    [5.0, 1.0]
    """
    return np.sqrt(np.einsum("...i,...i->...", vectors, vectors))


def bounds(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the least and the largest coordinates along each axis of points (n, 3), n > 0; each (3,).

    NumPy's reductions of such long and narrow arrays along their columns take twenty times as long.

    >>> [side.tolist() for side in bounds(np.array([[1.0, 5.0, 0.0], [2.0, 3.0, 0.0]]))]
    [[1.0, 3.0, 0.0], [2.0, 5.0, 0.0]]
    """
    return np.array([x.min() for x in points.T]), np.array([x.max() for x in points.T])


def extent(points: np.ndarray) -> np.ndarray:
    """Compute the sides of the bounding box of points (n, 3), n > 0; (3,).

    >>> extent(np.array([[1.0, 5.0, 0.0], [2.0, 3.0, 0.0]])).tolist()
    [1.0, 2.0, 0.0]
    """
    low, high = bounds(points)
    return high - low


def cross_products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Compute the cross products of vectors (..., 3), in a third of the time of `np.cross`.

    >>> cross_products(np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 2.0, 0.0]])).tolist()
    [[0.0, 0.0, 2.0]]
    """
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for axis, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.multiply(a[..., one], b[..., other], out=product[..., axis])
        product[..., axis] -= a[..., other] * b[..., one]
    return product


def differing_rows(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Mark rows (k, 3) that differ, (k,) bool.

    >>> differing_rows(np.zeros((2, 3)), np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]])).tolist()
    [False, True]
    """
    differs = a != b
    return differs[:, 0] | differs[:, 1] | differs[:, 2]


def mask(numbers: np.ndarray, n: int) -> np.ndarray:
    """Mark some of the numbers below n, (n,) bool.

    >>> mask(np.array([2, 0]), 4).tolist()
    [True, False, True, False]
    """
    marked = np.zeros(n, dtype=bool)
    marked[numbers] = True
    return marked


def index_of(numbers: np.ndarray, n: int) -> np.ndarray:
    """Index of each number below n in `numbers` (k,), -1 for a number that is not there; (n,) int32.

    >>> index_of(np.array([2, 0]), 4).tolist()
    [1, -1, 0, -1]
    """
    index = np.full(n, -1, np.int32)
    index[numbers] = np.arange(len(numbers), dtype=np.int32)
    return index


def find_rows(known: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Find the first row of `known` (k, w) that is equal to each row wanted (j, w), (j,) int64; -1 where there is none.

    >>> find_rows(np.array([[1, 2], [3, 4], [1, 2]]), np.array([[3, 4], [2, 1], [1, 2]])).tolist()
    [1, -1, 0]
    """
    rows = np.concatenate([known, wanted])
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    found = first[which.reshape(-1)[len(known) :]]
    return np.where(found < len(known), found, -1)
