"""Who wants to know that kernels are being compiled, which takes a minute and happens once."""

from __future__ import annotations

from collections.abc import Callable

#: Called, without arguments, when the first kernel of this process has to be compiled.
listeners: list[Callable[[], None]] = []

#: Number of kernels that this process had to compile so far, the one at hand included.
begun = 0


def tell() -> None:
    """A kernel is about to be compiled; the listeners hear of the first one alone."""
    global begun
    begun += 1
    if begun == 1:
        for listener in listeners:
            listener()
