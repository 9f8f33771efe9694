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

    An array that is taken is no longer the workspace's, until it is given back.

    >>> taken = workspace.take((20,), np.float32)
    >>> np.shares_memory(taken, workspace.array((4, 3), np.float64))
    False
    >>> workspace.give(taken)
    >>> np.shares_memory(taken, workspace.array((10, 2), np.float32))
    True
    """

    def __init__(self) -> None:
        self._bytes = np.empty(0, np.uint8)

    def array(self, shape: tuple[int, ...], dtype: type) -> np.ndarray:
        """Return an array of a shape and type, with any values; the array of an earlier call is no longer valid."""
        size = math.prod(shape) * np.dtype(dtype).itemsize
        if self._bytes.size < size:
            self.release()  # before there is more
            self._bytes = np.empty(size, np.uint8)
        return self._bytes[:size].view(dtype).reshape(shape)

    def take(self, shape: tuple[int, ...], dtype: type) -> np.ndarray:
        """Return an array as `array` does, whose memory is the caller's from then on."""
        taken = self.array(shape, dtype)
        self.release()
        return taken

    def give(self, array: np.ndarray) -> None:
        """Take over the memory of an array that nobody uses any more, in place of the own."""
        self._bytes = array.reshape(-1).view(np.uint8)

    def release(self) -> None:
        """Free the memory until an array is wanted again; the last one is no longer valid."""
        self._bytes = np.empty(0, np.uint8)
