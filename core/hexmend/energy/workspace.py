"""Memory for temporary arrays, which is used again by whoever needs it next."""

from __future__ import annotations

import math
import threading

import numpy as np


class Workspace(threading.local):
    """Memory of one thread, in which one array is at a time: memory that has been touched before is faster.

    Examples
    --------
    >>> workspace = Workspace()
    >>> first = workspace.array((4, 3), np.float64)
    >>> second = workspace.array((20,), np.float32)
    >>> second.dtype, np.shares_memory(first, second)
    (dtype('float32'), True)
    """

    def __init__(self) -> None:
        self._bytes = np.empty(0, np.uint8)

    def array(self, shape: tuple[int, ...], dtype: type) -> np.ndarray:
        """Return an array of a shape and type, with any values; one that was returned before is no longer valid."""
        size = math.prod(shape) * np.dtype(dtype).itemsize
        if self._bytes.size < size:
            self._bytes = np.empty(size, np.uint8)
        return self._bytes[:size].view(dtype).reshape(shape)

    def release(self) -> None:
        """Free the memory until an array is wanted again; the last one is no longer valid."""
        self._bytes = np.empty(0, np.uint8)
