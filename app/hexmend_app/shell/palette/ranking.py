"""Entries of the palette, and their order for a typed text."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from PySide6.QtGui import QIcon


@dataclass(frozen=True, eq=False, kw_only=True)
class PaletteEntry:
    """A command that is found by its name.

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
        """The name with its kind."""
        return f"{self.kind}: {self.name}" if self.kind else self.name


def ranked(entries: Iterable[PaletteEntry], text: str) -> list[PaletteEntry]:
    """The entries that contain every word of a text, best match first; equal matches keep their order.

    A name that begins with the text comes before one whose words begin with its words, then one that holds them, then
    one that needs its kind for them; what only the help speaks of comes last.

    >>> some = [PaletteEntry(name="Reset", do=print, help="Undo all."), PaletteEntry(name="Undo", do=print)]
    >>> some.append(PaletteEntry(name="Run", do=print))
    >>> [one.name for one in ranked(some, "un")]
    ['Undo', 'Run', 'Reset']
    """
    words = text.lower().split()
    found = [(rank, one) for one in entries if (rank := _rank(one, words)) is not None]
    return [one for _, one in sorted(found, key=lambda pair: pair[0])]


def _rank(entry: PaletteEntry, words: list[str]) -> int | None:
    """Rank of a match, 0 the best; None without a match."""
    name, title = entry.name.lower(), entry.title.lower()
    if name.startswith(" ".join(words)):
        return 0
    for rank, message in enumerate((name, title), start=1):
        begins = re.split(r"[\s\-–(:,]+", message)
        if all(any(one.startswith(word) for one in begins) for word in words):
            return rank
    for rank, message in enumerate((name, title, f"{title} {entry.help.lower()}"), start=3):
        if all(word in message for word in words):
            return rank
    return None
