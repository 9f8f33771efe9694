"""Files that an Abaqus deck includes, joined with it to one text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from hexmend.errors import FileError, HexmendError
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.formats.abaqus.deck import Card, Deck, DeckFile, Piece, Reference
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
    root = DeckFile(path, read_text_bytes(path))
    deck = Deck(path, root.data)
    if next(_including(deck), None) is None:
        return deck
    joined = _Joined(root)
    joined.add(root, ())
    return Deck(path, b"".join(joined.texts), tuple(joined.pieces), joined.hidden)


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
        return {one.path.resolve() for piece in read_deck(path).pieces[:1] for one in list(piece.file.walk())[1:]}
    except (HexmendError, OSError):
        return set()


class _Joined:
    """The texts joined so far."""

    def __init__(self, root: DeckFile):
        self.root, self.texts, self.pieces, self.hidden = root, [], [], []
        self._length, self._n_files = 0, 0

    def add(self, file: DeckFile, parents: tuple[Path, ...]) -> None:
        """Add a file, and the files that it includes after the keywords that name them."""
        at = 0
        deck = Deck(file.path, file.data)
        for begin, card in _including(deck):
            self._put(file, at, card.begin)
            if card.name == "INCLUDE":
                own = self.pieces[-1]
                keyword = own.begin + begin - own.file_begin
                self.hidden.append((keyword, own.begin + len(file.data[at : card.begin].rstrip())))
            at = card.begin
            included = self._open(file, begin, card, (*parents, file.path.resolve()))
            file.included.append(included)
            self.add(included, (*parents, file.path.resolve()))
        self._put(file, at, len(file.data))

    def _open(self, file: DeckFile, begin: int, card: Card, parents: tuple[Path, ...]) -> DeckFile:
        name = unquoted(card.options["INPUT"])
        place = f"*{card.name} in line {card.line} of {file.path.name} reads {quoted(name)}"
        self._n_files += 1
        folders = (self.root.path.parent, file.path.parent)
        found = [folder / name for folder in folders if name and (folder / name).is_file()]
        if not found:
            problem, remedy = f"{place}, which does not exist in {folders[0].absolute()}", "Copy it there."
            raise FileError(self.root.path, problem, remedy)
        if found[0].resolve() in parents or len(parents) > _MAX_DEPTH or self._n_files > _MAX_FILES:
            raise FileError(self.root.path, f"{place}: files include each other without end", "Correct the file.")
        check_readable(found[0], "a file of Abaqus keywords")
        match = _INPUT.search(file.data, begin)
        return DeckFile(found[0], read_text_bytes(found[0]), Reference(file, *match.span(1), name))

    def _put(self, file: DeckFile, begin: int, end: int) -> None:
        """Add a part of a file, and a line end where it has none."""
        text = file.data[begin:end]
        self.pieces.append(Piece(file, self._length, begin, len(text)))
        self.texts.append(text if text.endswith((b"\n", b"\r")) or not text else text + b"\n")
        self._length += len(self.texts[-1])


def _including(deck: Deck) -> Iterator[tuple[int, Card]]:
    """Cards that include a file, each with the begin of its keyword."""
    at = 0
    for card in deck.cards():
        if card.name in _INCLUDING and "INPUT" in card.options:
            yield deck.data.rfind(b"*", at, card.begin), card
        at = card.begin
