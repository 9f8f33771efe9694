"""What the palette offers, and in which order what is typed finds it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from PySide6.QtGui import QIcon


@dataclass(frozen=True, eq=False, kw_only=True)
class Entry:
    """Something that can be found by its name and then done.

    Parameters
    ----------
    name : str
    do : callable
    help : str
        One sentence.
    kind : str
        What it is, where it is no command: "Panel", "Method"...
    keys : str
        In the desktop's words, "" for none.
    icon : QIcon
    """

    name: str
    do: Callable[[], object]
    help: str = ""
    kind: str = ""
    keys: str = ""
    icon: QIcon = field(default_factory=QIcon)

    @property
    def title(self) -> str:
        """The name with what it is."""
        return f"{self.kind}: {self.name}" if self.kind else self.name


def ranked(entries: Iterable[Entry], text: str) -> list[Entry]:
    """Those that have every word of a text, those with the better match first; of equal ones, as they come.

    A name that begins with the text comes before one whose words begin with its words, then one that holds them, then
    one that needs its kind for them; what only the help speaks of comes last.

    >>> some = [Entry(name="Reset", do=print, help="Undo all."), Entry(name="Undo", do=print)]
    >>> some.append(Entry(name="Run", do=print))
    >>> [one.name for one in ranked(some, "un")]
    ['Undo', 'Run', 'Reset']
    """
    words = text.lower().split()
    found = [(rank, one) for one in entries if (rank := _rank(one, words)) is not None]
    return [one for _, one in sorted(found, key=lambda pair: pair[0])]


def _rank(entry: Entry, words: list[str]) -> int | None:
    """How well an entry matches, 0 the best; None where it does not."""
    name, title = entry.name.lower(), entry.title.lower()
    if name.startswith(" ".join(words)):
        return 0
    for rank, said in enumerate((name, title), start=1):
        begins = re.split(r"[\s\-–(:,]+", said)
        if all(any(one.startswith(word) for one in begins) for word in words):
            return rank
    for rank, said in enumerate((name, title, f"{title} {entry.help.lower()}"), start=3):
        if all(word in said for word in words):
            return rank
    return None
