"""Files that an Abaqus deck includes, whose cards come in its own."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.coordinates import deck_files
from hexmend.io.formats.abaqus.deck import NEWLINE, Card, Deck
from hexmend.io.formats.abaqus.model import unquoted

#: Keywords whose data lines may be in another file.
_INCLUDING = ("INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE")
_INPUT = re.compile(rb"input\s*=[ \t]*(\"[^\"\n]*\"|[^,\r\n]*)", re.IGNORECASE)


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
    """Find the files that a deck includes; see `hexmend.io.coordinates.deck_files.included_files`."""
    return deck_files.included_files(path, read_deck)


class _Opener:
    """Opens the files that a deck includes, and lists the cards of all in `root.cards`."""

    def __init__(self, root: Deck):
        self.root = root

    def add_cards(self, file: Deck, before: Card | None) -> Card | None:
        """Add the cards of a file; data lines at its begin continue the card `before`. Returns the last."""
        cards = list(file.own_cards())
        before = self._continue(before, file, 0, cards[0].at if cards else len(file.data))
        for card in cards:
            if card.name != "INCLUDE":
                self.root.cards.append(card)
                before = card
            if card.name in _INCLUDING and "INPUT" in card.options:
                before = self.add_cards(self._open(file, card), before)
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
        match = _INPUT.search(file.data, card.at)
        where = f"*{card.name} in line {file.data.count(NEWLINE, 0, card.at) + 1}"
        return file.include(unquoted(card.options["INPUT"]), *match.span(1), where)
