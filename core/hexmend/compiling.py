"""Who wants to know that kernels are being compiled, which takes a minute and happens once."""

from __future__ import annotations

from collections.abc import Callable

#: Called, without arguments, when the first kernel of this process has to be compiled.
listeners: list[Callable[[], None]] = []

_told = False


def tell() -> None:
    """A kernel is about to be compiled; the listeners hear of the first one alone."""
    global _told
    if not _told:
        _told = True
        for listener in listeners:
            listener()
