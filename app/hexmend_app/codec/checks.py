"""Checks of values in session files."""

from __future__ import annotations

from collections.abc import Container, Iterable

#: Maximum of counts in session files.
MAX_COUNT = 1_000_000


def check_count(items: str, count: int) -> None:
    """Raise `ValueError` unless the number of `items` is from 1 to `MAX_COUNT`."""
    if not 1 <= count <= MAX_COUNT:
        raise ValueError(f"the number of {items} is not from 1 to {MAX_COUNT:,}")


def check_known(kind: str, names: Iterable[str], known: Container[str]) -> None:
    """Raise `ValueError` unless all names of a kind of thing are known."""
    for name in names:
        if name not in known:
            raise ValueError(f"there is no {kind} {name!r}")
