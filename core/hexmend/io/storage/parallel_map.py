"""A function over many items in as many threads as the kernels use, for functions that leave Python's lock."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from hexmend.kernels import threads

T = TypeVar("T")
R = TypeVar("R")


def parallel_map(function: Callable[[T], R], items: Sequence[T]) -> Iterator[R]:
    """Yield function(item) of each item in turn; as many are computed at once as the kernels have threads.

    Parameters
    ----------
    function : callable
        Such as one that compresses a block by zlib.
    items : sequence

    Raises
    ------
    Exception
        That of the first item for which the function raises one.

    Examples
    --------
    >>> list(parallel_map(len, ["a", "bb", ""]))
    [1, 2, 0]
    """
    count = threads()
    if count == 1 or len(items) < 2:
        yield from map(function, items)
        return
    with ThreadPoolExecutor(count) as pool:
        for begin in range(0, len(items), count):
            batch = items[begin : begin + count]
            try:
                results = pool.map(function, batch)
            except RuntimeError:  # the system starts no more threads
                results = map(function, batch)
            yield from results
