"""Checks of values in session files."""

from __future__ import annotations

from collections.abc import Container, Iterable

#: The largest count that a session file may have for a setting.
MAX_COUNT = 1_000_000


def check_count(subject: str, count: int) -> None:
    """Raise `ValueError` unless a count is from 1 to `MAX_COUNT`."""
    if not 1 <= count <= MAX_COUNT:
        raise ValueError(f"the number of {subject} is not from 1 to {MAX_COUNT:,}")


def check_known(subject: str, names: Iterable[str], known: Container[str]) -> None:
    """Raise `ValueError` unless all names are known."""
    for name in names:
        if name not in known:
            raise ValueError(f"there is no {subject} {name!r}")
