"""Registries: things that announce themselves by name and are found by it."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from typing import Generic, TypeVar

from hexmend.errors import ParameterError

T = TypeVar("T")


class Registry(Mapping[str, T], Generic[T]):
    """Entries by name, in the order of registration.

    Parameters
    ----------
    kind : str
        What an entry is called in an error message ("method", "format").

    Examples
    --------
    >>> shapes = Registry("shape")
    >>> shapes.add("cube", 6)
    6
    >>> shapes["cub"]
    Traceback (most recent call last):
    hexmend.errors.ParameterError: there is no shape 'cub': did you mean cube? (known: cube)
    """

    def __init__(self, kind: str):
        self.kind = kind
        self._entries: dict[str, T] = {}

    def add(self, name: str, entry: T) -> T:
        """Register `entry`; two entries of one name are a programming error."""
        if name in self._entries:
            raise ValueError(f"{self.kind} {name!r} is registered twice")
        self._entries[name] = entry
        return entry

    def __getitem__(self, name: str) -> T:
        try:
            return self._entries[name]
        except KeyError:
            near = difflib.get_close_matches(str(name), self._entries, n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            known = ", ".join(self._entries)
            raise ParameterError(f"there is no {self.kind} {name!r}: {hint}(known: {known})") from None

    def __contains__(self, name: object) -> bool:
        return name in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)
