"""Registries of named entries, and loading of entries from other distributions."""

from __future__ import annotations

import difflib
import logging
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any, Generic, TypeVar

from hexmend.errors import ParameterError

T = TypeVar("T")

log = logging.getLogger(__name__)


class Registry(Mapping[str, T], Generic[T]):
    """Entries by name, in the order of registration.

    Parameters
    ----------
    kind : str
        Name of an entry in error messages ("method", "format").
    load_more : callable, optional
        Adds entries of other distributions. It is called once, when an unknown name or all entries are requested, so
        that access to known entries does not wait for the search.

    Examples
    --------
    >>> shapes = Registry("shape")
    >>> shapes.add("cube", 6)
    6
    >>> shapes["cub"]
    Traceback (most recent call last):
    hexmend.errors.ParameterError: there is no shape 'cub': did you mean cube? (known: cube)
    """

    def __init__(self, kind: str, load_more: Callable[[], None] | None = None):
        self.kind = kind
        self._load_more = load_more
        self._lock = threading.RLock()
        self._entries: dict[str, T] = {}

    def add(self, name: str, entry: T) -> T:
        """Register an entry and return it; raises `ValueError` for a name that is registered already."""
        if name in self._entries:
            raise ValueError(f"{self.kind} {name!r} is registered twice")
        self._entries[name] = entry
        return entry

    def expect(self, name: str, loaded: object) -> None:
        """Raise `ValueError` unless importing the object of an entry point has registered its name."""
        if name not in self._entries:
            raise ValueError(f"{loaded!r} does not register a {self.kind} of this name")

    def __repr__(self) -> str:
        """List the names, for a prompt."""
        return f"<{self.kind}s: {', '.join(self)}>"

    def __getitem__(self, name: str) -> T:
        try:
            return self._entries[name] if name in self._entries else self._all()[name]
        except KeyError:
            near = difflib.get_close_matches(str(name), self._entries, n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            known = ", ".join(self._entries)
            raise ParameterError(f"there is no {self.kind} {name!r}: {hint}(known: {known})") from None

    def __contains__(self, name: object) -> bool:
        return name in self._entries or name in self._all()

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def _all(self) -> dict[str, T]:
        with self._lock:  # a second thread waits until the first has loaded them
            if self._load_more is not None:
                load, self._load_more = self._load_more, None
                load()
        return self._entries


def load_entry_points(group: str, kind: str, take: Callable[[str, object], object]) -> None:
    """Load the entry points of other distributions; those that fail are left out with a warning in the log.

    Parameters
    ----------
    group : str
        Entry-point group.
    kind : str
        Name of an entry in messages.
    take : callable
        Function of each entry's name and loaded object; raises for an object of another type.
    """
    for entry in sorted(_entry_points(tuple(sys.path)).select(group=group), key=lambda entry: entry.name):
        try:
            take(entry.name, entry.load())
        except (Exception, SystemExit) as error:  # a faulty plug-in must not stop the program
            of = entry.dist.name if entry.dist else "an unknown distribution"
            reason = " ".join(f"{type(error).__name__}: {error}".split())
            log.warning("hexmend: the %s %s of %s is left out: %s", kind, entry.name, of, reason)


@cache
def _entry_points(path: tuple[str, ...]) -> Any:
    """Read the entry points of all distributions on Python's path, which takes about 30 ms."""
    from importlib.metadata import entry_points

    return entry_points()
