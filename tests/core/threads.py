"""The same work by different numbers of threads."""

from collections.abc import Callable
from typing import Any

from hexmend import kernels


def by_threads(work: Callable[[], Any], counts: tuple[int, ...] = (1, 3)) -> list[Any]:
    """Return what a function gives with each of some numbers of threads."""
    most, results = kernels.threads(), []
    try:
        for count in counts:
            kernels.set_threads(count)
            results.append(work())
    finally:
        kernels.set_threads(most)
    return results
