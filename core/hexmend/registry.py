"""Registries: things that announce themselves by name and are found by it."""

from __future__ import annotations

import difflib
import logging
import threading
from collections.abc import Callable, Iterator, Mapping
from typing import Generic, TypeVar

from hexmend.errors import ParameterError

T = TypeVar("T")

log = logging.getLogger(__name__)


class Registry(Mapping[str, T], Generic[T]):
    """Entries by name, in the order of registration.

    Parameters
    ----------
    kind : str
        What an entry is called in an error message ("method", "format").
    others : callable, optional
        Adds entries from elsewhere. Called once, as soon as a name is asked for that is not there or all of them are:
        who uses what is there does not pay for the search.

    Examples
    --------
    >>> shapes = Registry("shape")
    >>> shapes.add("cube", 6)
    6
    >>> shapes["cub"]
    Traceback (most recent call last):
    hexmend.errors.ParameterError: there is no shape 'cub': did you mean cube? (known: cube)
    """

    def __init__(self, kind: str, others: Callable[[], None] | None = None):
        self.kind = kind
        self._others = others
        self._asked = threading.RLock()
        self._entries: dict[str, T] = {}

    def add(self, name: str, entry: T) -> T:
        """Register `entry`; two entries of one name are a programming error, a `ValueError`."""
        if name in self._entries:
            raise ValueError(f"{self.kind} {name!r} is registered twice")
        self._entries[name] = entry
        return entry

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
        with self._asked:  # a second thread waits until the first has found them all
            if self._others is not None:
                add, self._others = self._others, None
                add()
        return self._entries


def load_entry_points(group: str, kind: str, take: Callable[[str, object], object]) -> None:
    """Load what other distributions add; what cannot be loaded or taken is told of, and the others go on.

    Parameters
    ----------
    group : str
        The entry-point group.
    kind : str
        What an entry is called in a message.
    take : callable
        Given each entry's name and what it names; raises for what is not wanted.
    """
    from importlib.metadata import entry_points  # which reads what is said of every distribution there is

    for entry in sorted(entry_points(group=group), key=lambda entry: entry.name):
        try:
            take(entry.name, entry.load())
        except (Exception, SystemExit) as error:  # whatever is wrong with it, the rest of the program is not to blame
            of = entry.dist.name if entry.dist else "an unknown distribution"
            said = " ".join(f"{type(error).__name__}: {error}".split())
            log.warning("hexmend: the %s %s of %s is left out: %s", kind, entry.name, of, said)
