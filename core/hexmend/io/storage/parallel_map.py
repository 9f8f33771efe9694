"""A function over many items in as many threads as the kernels use, for functions that leave Python's lock."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
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
    for begin in range(0, len(items), count):
        batch = items[begin : begin + count]
        results: list[R | BaseException] = [None] * len(batch)  # type: ignore[list-item]

        def compute(k: int, batch: Sequence[T] = batch, results: list = results) -> None:
            try:
                results[k] = function(batch[k])
            except BaseException as error:  # raised again below, in the order of the items
                results[k] = error

        others = []
        for k in range(1, len(batch)):
            thread = threading.Thread(target=compute, args=(k,))
            try:
                thread.start()
            except RuntimeError:  # the system has no more threads
                compute(k)
            else:
                others.append(thread)
        compute(0)
        for thread in others:
            thread.join()
        for result in results:
            if isinstance(result, BaseException):
                raise result
            yield result
