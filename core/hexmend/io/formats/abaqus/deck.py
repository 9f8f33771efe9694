"""Input deck of Abaqus as cards: a keyword line with its parameters, and the data lines that follow.

Files that an Abaqus deck includes, whose cards and data lines come in the places that name them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles, included_files
from hexmend.io.coordinates.text_coordinates import word_ranges
from hexmend.io.formats.decks.lines import CardLines, line_ranges, trimmed

_COMMENT = re.compile(rb"^[ \t]*\*\*[^\n]*", re.MULTILINE)
#: A line whose first letter is a single asterisk; it goes on in the next line behind a comma.
_KEYWORD = re.compile(rb"^[ \t]*\*(?!\*)(?:[^\n]*,[ \t]*\n)*[^\n]*", re.MULTILINE)
_FIELD = re.compile(r'(?:[^,"]|"[^"]*"?)+')
NEWLINE = b"\n"
#: Fields of a node: number, x, y and z.
NODE_FIELDS = (1, 1, 1, 1)


@dataclass(frozen=True, eq=False)
class Card:
    """Keyword line and data lines.

    Parameters
    ----------
    name : str
        Keyword in upper case, such as "NODE".
    options : dict of str to str
        Parameters by name in upper case; "" for those without a value.
    deck : Deck
    begin, end : int
        Byte range of the data lines in `Deck.data`.
    at : int
        Offset of the keyword.
    """

    name: str
    options: dict[str, str]
    deck: Deck
    begin: int
    end: int
    at: int

    @property
    def place(self) -> str:
        """Place of the card, such as "line 12", or "line 3 of nodes.inp" in an included file."""
        return self.deck.place(self.at)

    def lines(self) -> list[str]:
        """Return the data lines that are not blank, stripped."""
        text = self.deck.data[self.begin : self.end].decode("utf-8", errors="replace")
        return [line for line in map(str.strip, text.split("\n")) if line]

    def fields(self) -> list[list[str]]:
        """Return the fields of each data line; a comma at its end adds none."""
        return [[field.strip() for field in _split_fields(line.removesuffix(","))] for line in self.lines()]


class Deck:
    """The cards of a deck and of the files that it includes, and parsers of their data lines.

    Parameters
    ----------
    path : Path
        Named in errors.
    files : JoinedFiles

    Attributes
    ----------
    data : bytes
        Their text, with blanks in place of comments.
    cards : list of Card
    """

    def __init__(self, path: Path, files: JoinedFiles):
        self.path, self.files, self.data = path, files, files.data
        if b"**" in self.data:
            self.data = _COMMENT.sub(lambda comment: b" " * len(comment.group()), self.data)
        found = list(keywords(self.data))
        ends = [*(first for first, *_ in found[1:]), len(self.data)]
        self.cards = [
            Card(name, options, self, min(begin, end), end, first)
            for (first, begin, name, options), end in zip(found, ends, strict=False)
        ]

    @cached_property
    def _cursor(self) -> ByteCursor:
        return ByteCursor(self.path, self.data.replace(b",", b" "))

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return FileError(self.path, problem, remedy)

    def place(self, at: int) -> str:
        """Return the place of an offset, such as "line 12", or "line 3 of nodes.inp" in an included file."""
        return self.files.place(at)

    def node_lines(self, card: Card) -> CardLines:
        """Return the data lines of a *NODE card that are not blank."""
        begin, end = trimmed(np.frombuffer(self.data, np.uint8), *line_ranges(self.data, card.begin, card.end))
        return CardLines("*NODE", self.files, card.at, begin[begin < end], end[begin < end], None)

    def nodes(self, card: Card) -> tuple[np.ndarray, np.ndarray]:
        """Return the numbers, (k,) int64, and coordinates, (k, 3) float64, of a *NODE card; blank fields are 0."""
        rows = self.node_lines(card).cards(NODE_FIELDS).reals(0, 4)
        numbers = np.where(np.isfinite(rows[:, 0]) & (np.abs(rows[:, 0]) < 2**53), rows[:, 0], 0.5)
        wrong = np.flatnonzero(numbers != np.floor(numbers))
        if wrong.size:
            raise self.error(f"*NODE in {card.place} has the number {rows[wrong[0], 0]:g}: expected a whole number")
        return numbers.astype(np.int64), np.ascontiguousarray(rows[:, 1:])

    def element_rows(self, card: Card, width: int) -> tuple[np.ndarray, int]:
        """Return the numbers of the elements of a card, (k, width) int64, and the number of lines that hold more.

        An element begins in a line of its own and is continued in the next ones until it has `width` numbers; what else
        the last of these lines holds is ignored, as Abaqus and CalculiX do.
        """
        self._cursor.pos = card.begin
        numbers = self._cursor.read_numbers_to("*ELEMENT", card.end, np.int64)
        begins, _ = word_ranges(self._cursor.data, card.begin, card.end)
        breaks = card.begin + np.flatnonzero(np.frombuffer(self.data, np.uint8)[card.begin : card.end] == NEWLINE[0])
        counts = np.diff(np.searchsorted(begins, [card.begin, *breaks, card.end]))
        counts = counts[counts > 0]
        if (counts == width).all():
            return numbers.reshape(-1, width), 0
        starts, n_longer, have = [], 0, width
        for at, count in zip((np.cumsum(counts) - counts).tolist(), counts.tolist(), strict=True):
            if have >= width:
                starts.append(at)
                have = 0
            elif have + count > width and not self._continues(begins[at]):
                break
            have += count
            n_longer += have > width
        else:
            if have >= width:
                return numbers[np.array(starts)[:, None] + np.arange(width)], n_longer
        place = self.place(int(begins[starts[-1]]))
        problem = f"*ELEMENT in {card.place}: the element in {place} has {have} numbers"
        raise self.error(f"{problem}: expected {width}, its own and those of {width - 1} nodes", DAMAGED)

    def _continues(self, at: int) -> bool:
        """Return True if the line of an offset follows one that ends in a comma."""
        end = self.data.rfind(NEWLINE, 0, at) + 1
        return self.data[max(0, end - 4096) : end].rstrip()[-1:] == b","


def keywords(data: bytes) -> Iterator[tuple[int, int, str, dict[str, str]]]:
    """Iterate over keywords: their offset, that of the data lines, the name, and the parameters."""
    for found in _KEYWORD.finditer(data):
        name, options = _split_keyword(found[0].decode("utf-8", errors="replace"))
        yield found.start(), min(found.end() + 1, len(data)), name, options


def unquoted(name: str) -> str:
    """Name without the quotes around it."""
    return name.strip().strip('"')


def _split_keyword(head: str) -> tuple[str, dict[str, str]]:
    """Keyword and parameters of a keyword line."""
    fields = _split_fields(head.strip().lstrip("*").strip())
    options = {}
    for one in fields[1:]:
        key, _, value = one.partition("=")
        options[" ".join(key.upper().split())] = value.strip()
    return " ".join((fields[0] if fields else "").upper().split()), options


def _split_fields(line: str) -> list[str]:
    """Split a line at its commas outside of quotes."""
    return _FIELD.findall(line) if '"' in line else line.split(",")


#: Keywords whose data lines may be in another file.
_INCLUDING = ("INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE")
_INPUT = re.compile(rb"input\s*=[ \t]*(\"[^\"\n]*\"|[^,\r\n]*)", re.IGNORECASE)


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions)


def read_deck(path: Path) -> Deck:
    """Read the cards of a deck and of all files that it includes."""
    return Deck(path, join(path))


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for first, end, name, options in keywords(data):
        if name in _INCLUDING and "INPUT" in options:
            file = unquoted(options["INPUT"]), *_INPUT.search(data, first).span(1)
            yield Inclusion(first, first if name == "INCLUDE" else end, end, f"*{name}", [file])


#: included_files_of(path) finds the files that a deck includes.
included_files_of = partial(included_files, join)
