"""Entries of the command palette, and their ranking for a typed text."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from PySide6.QtGui import QIcon


@dataclass(frozen=True, eq=False, kw_only=True)
class PaletteEntry:
    """Command of the palette.

    Parameters
    ----------
    name : str
    run : callable
        Called without arguments to carry it out.
    help : str
        One sentence.
    kind : str
        Category, such as "Panel" or "Method"; "" for a command.
    keys : str
        Shortcut in the notation of the desktop; "" for none.
    icon : QIcon
    enabled : bool
        False for a command that cannot be run now, which only a text that matches it finds.
    """

    name: str
    run: Callable[[], object]
    help: str = ""
    kind: str = ""
    keys: str = ""
    icon: QIcon = field(default_factory=QIcon)
    enabled: bool = True

    @property
    def title(self) -> str:
        """Kind and name."""
        return f"{self.kind}: {self.name}" if self.kind else self.name


def ranked(entries: Iterable[PaletteEntry], text: str) -> list[PaletteEntry]:
    """Return the entries that contain every word of a text, best match first; equal matches keep their order.

    Matches at the start of the name rank first, then matches at starts of words of the name, then of the title; after
    these, matches anywhere in the name, in the title, and in the help. Commands that cannot be run now come last; they
    are left out without a text.

    >>> entries = [PaletteEntry(name="Reset", run=print, help="Undo all."), PaletteEntry(name="Undo", run=print)]
    >>> entries.append(PaletteEntry(name="Run", run=print))
    >>> [entry.name for entry in ranked(entries, "un")]
    ['Undo', 'Run', 'Reset']
    """
    words = text.lower().split()
    found = [entry for entry in entries if words or entry.enabled]
    matches = [(not entry.enabled, rank, entry) for entry in found if (rank := _rank(entry, words)) is not None]
    return [entry for *_, entry in sorted(matches, key=lambda match: match[:2])]


def _rank(entry: PaletteEntry, words: list[str]) -> int | None:
    """Return the rank of a match, 0 for the best; None if the entry does not match."""
    name, title = entry.name.lower(), entry.title.lower()
    if name.startswith(" ".join(words)):
        return 0
    for rank, text in enumerate((name, title), start=1):
        parts = re.split(r"[\s\-–(:,]+", text)
        if all(any(part.startswith(word) for part in parts) for word in words):
            return rank
    for rank, text in enumerate((name, title, f"{title} {entry.help.lower()}"), start=3):
        if all(word in text for word in words):
            return rank
    return None
