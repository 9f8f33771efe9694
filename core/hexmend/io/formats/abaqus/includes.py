"""Files that an Abaqus deck includes, whose cards come in its own."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from hexmend.errors import FileError, HexmendError
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.formats.abaqus.deck import NEWLINE, Card, Deck, Reference
from hexmend.io.formats.abaqus.model import unquoted
from hexmend.io.storage.readable import check_readable

#: Keywords whose data lines may be in another file.
_INCLUDING = ("INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE")
_INPUT = re.compile(rb"input\s*=[ \t]*(\"[^\"\n]*\"|[^,\r\n]*)", re.IGNORECASE)
#: Files that include each other, and all files of a deck.
_MAX_DEPTH, _MAX_FILES = 10, 1000


def read_deck(path: Path) -> Deck:
    """Read a deck with all files that it includes.

    Raises
    ------
    FileError
        For an included file that cannot be read, or one that includes itself.
    """
    root = Deck(path, read_text_bytes(path))
    _Opener(root).add_cards(root, None)
    return root


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes, and those that they include.

    Parameters
    ----------
    path : Path

    Returns
    -------
    set of Path
        With links resolved; empty for a file that is missing or cannot be read.
    """
    try:
        return {one.path.resolve() for one in list(read_deck(path).walk())[1:]}
    except (HexmendError, OSError):
        return set()


class _Opener:
    """Opens the files that a deck includes, and lists the cards of all in `root.cards`."""

    def __init__(self, root: Deck):
        self.root, self._n_files = root, 0

    def add_cards(self, file: Deck, before: Card | None) -> Card | None:
        """Add the cards of a file; data lines at its begin continue the card `before`. Returns the last."""
        cards = list(file.own_cards())
        before = self._continue(before, file, 0, cards[0].at if cards else len(file.data))
        for card in cards:
            if card.name != "INCLUDE":
                self.root.cards.append(card)
                before = card
            if card.name in _INCLUDING and "INPUT" in card.options:
                included = self._open(file, card)
                file.included.append(included)
                before = self.add_cards(included, before)
            if card.name == "INCLUDE":
                before = self._continue(before, file, card.begin, card.end)
        return before

    def _continue(self, card: Card | None, file: Deck, begin: int, end: int) -> Card | None:
        """Add data lines of a file that go on after those of a card elsewhere; returns the last part of the card.

        Those of keywords that are not read are left out.
        """
        if card is None or not file.data[begin:end].strip() or card.name not in (*_INCLUDING, "INSTANCE"):
            return card
        is_cut = card.name == "ELEMENT" and card.deck.data[card.begin : card.end].rstrip().endswith(b",")
        if is_cut or card.name == "INSTANCE":
            own = "a line of its data continues" if is_cut else "its data lines are"
            problem = f"*{card.name} in {card.place}: {own} elsewhere, in {file.path.name} where that is included"
            raise FileError(self.root.path, problem, f"Write these lines where *{card.name} is.")
        part = replace(card, deck=file, begin=begin, end=end, at=begin)
        self.root.cards.append(part)
        return part

    def _open(self, file: Deck, card: Card) -> Deck:
        parents = [one.path.resolve() for one in file.lineage()]
        name = unquoted(card.options["INPUT"])
        name = name if (self.root.path.parent / name).is_file() else name.replace("\\", "/")  # of Windows
        place = (
            f"*{card.name} in line {file.data.count(NEWLINE, 0, card.at) + 1} of {file.path.name} reads {quoted(name)}"
        )
        self._n_files += 1
        folders = (self.root.path.parent, file.path.parent)
        found = [folder / name for folder in folders if name and (folder / name).is_file()]
        if not found:
            problem, remedy = f"{place}, which does not exist in {folders[0].absolute()}", "Copy it there."
            raise FileError(self.root.path, problem, remedy)
        if found[0].resolve() in parents or len(parents) > _MAX_DEPTH or self._n_files > _MAX_FILES:
            raise FileError(self.root.path, f"{place}: files include each other without end", "Correct the file.")
        check_readable(found[0], "a file of Abaqus keywords")
        match = _INPUT.search(file.data, card.at)
        return Deck(found[0], read_text_bytes(found[0]), Reference(file, *match.span(1), name))
