"""Input deck of Abaqus as cards: a keyword line with its parameters, and the data lines that follow.

Files of an Abaqus deck, and their parts in the text that joins them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted


@dataclass(frozen=True, eq=False)
class Reference:
    """Name of an included file in the file that includes it.

    Parameters
    ----------
    parent : DeckFile
    begin, end : int
        Byte range of the name in the parent, with quotes if it has them.
    name : str
        The name without quotes.
    """

    parent: DeckFile
    begin: int
    end: int
    name: str


@dataclass(eq=False)
class DeckFile:
    """The deck or a file that it includes; a file that is included twice is two of them.

    Parameters
    ----------
    path : Path
    data : bytes
        Its content.
    reference : Reference or None
        None for the deck itself.
    included : list of DeckFile
    """

    path: Path
    data: bytes
    reference: Reference | None = None
    included: list[DeckFile] = field(default_factory=list)

    def walk(self) -> Iterator[DeckFile]:
        """Iterate over the file and all files that it includes, included ones last."""
        yield self
        for one in self.included:
            yield from one.walk()


@dataclass(frozen=True, eq=False)
class Piece:
    """Part of a file in the joined text: its offset there and in the file, and its length."""

    file: DeckFile
    begin: int
    file_begin: int
    length: int


_COMMENT = re.compile(rb"^[ \t]*\*\*[^\n]*", re.MULTILINE)
_FIELD = re.compile(r'(?:[^,"]|"[^"]*"?)+')
_BLANKS = b" \t\r\v\f"
#: Blank fields, and exponents with the letter D, which NumPy does not parse; in data lines without blanks.
_IRREGULAR = (b",,", b"\n,", b"d", b"D")


@dataclass(frozen=True)
class Card:
    """Keyword line and its data lines.

    Parameters
    ----------
    name : str
        Keyword in upper case, such as "NODE".
    options : dict of str to str
        Parameters by name in upper case; "" for those without a value.
    begin, end : int
        Byte range of the data lines in `Deck.data`.
    line : int
        Line of the keyword, from 1.
    """

    name: str
    options: dict[str, str]
    begin: int
    end: int
    line: int


class Deck:
    """The cards of a file, and parsers of their data lines.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    data : bytes
        Content of the file, joined with those that it includes.
    pieces : sequence of Piece
        Parts of files in the content, see `hexmend.io.formats.abaqus.deck`; empty for a file without others.
    hidden : sequence of tuple of int
        Byte ranges of the lines that include a file, which are read as blank: the data lines of a keyword may follow.

    Attributes
    ----------
    given : bytes
        The content as it is.
    data : bytes
        The content, with blanks in place of comments and lines that end in "\\n"; offsets are those of `given`.
    """

    def __init__(self, path: Path, data: bytes, pieces: Sequence[Piece] = (), hidden: Sequence[tuple[int, int]] = ()):
        self.given, self.pieces = data, pieces
        for begin, end in hidden:
            data = data[:begin] + b" " * (end - begin) + data[end:]
        if b"\r" in data:
            data = data.replace(b"\r\n", b" \n").replace(b"\r", b"\n")
        if b"**" in data:
            data = _COMMENT.sub(lambda comment: b" " * len(comment.group()), data)
        self.path, self.data = path, data

    @cached_property
    def _cursor(self) -> ByteCursor:
        return ByteCursor(self.path, self.data.replace(b",", b" "))

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return FileError(self.path, problem, remedy)

    def place(self, card: Card) -> str:
        """Describe the place of a card, such as "line 12", or "line 3 of nodes.inp" in an included file."""
        at = card.begin - 1
        for piece in self.pieces:
            if piece.begin <= at <= piece.begin + piece.length and piece.file.reference is not None:
                line = piece.file.data.count(b"\n", 0, piece.file_begin + at - piece.begin) + 1
                return f"line {line} of {piece.file.path.name}"
        return f"line {card.line}"

    def cards(self) -> Iterator[Card]:
        """Iterate over all cards in order."""
        line, counted_to, next_begin = 1, 0, 0
        keywords = list(_keyword_lines(self.data))
        for k, (first, last) in enumerate(keywords):
            if first < next_begin:
                continue
            line += self.data.count(b"\n", counted_to, first)
            counted_to = first
            head, begin = self.data[first:last], last + 1
            while head.rstrip().endswith(b",") and begin < len(self.data):  # continued on the next line
                after = self.data.find(b"\n", begin)
                after = len(self.data) if after < 0 else after
                head, begin = head + self.data[begin:after], after + 1
            next_begin = begin
            end = keywords[k + 1][0] if k + 1 < len(keywords) else len(self.data)
            end = max(end, last)
            name, options = _split_keyword(head.decode("utf-8", errors="replace"))
            yield Card(name, options, min(begin, end), end, line)

    def lines(self, card: Card) -> list[str]:
        """Return the data lines that are not blank, stripped."""
        text = self.data[card.begin : card.end].decode("utf-8", errors="replace")
        return [line for line in map(str.strip, text.split("\n")) if line]

    def fields(self, card: Card) -> list[list[str]]:
        """Return the fields of each data line; a comma at its end adds none."""
        return [[field.strip() for field in _split_fields(line.removesuffix(","))] for line in self.lines(card)]

    def nodes(self, card: Card) -> tuple[np.ndarray, np.ndarray]:
        """Return the numbers, (k,) int64, and coordinates, (k, 3) float64, of a *NODE card; blank fields are 0."""
        text = self.data[card.begin : card.end]
        bare = text.translate(None, _BLANKS)
        first = bare.lstrip(b"\n").split(b"\n", 1)[0].removesuffix(b",")
        width = first.count(b",") + 1 if first else 0
        breaks = np.frombuffer(b"\n" + bare, np.uint8) == ord("\n")
        lines = int(np.count_nonzero(breaks[:-1] & ~breaks[1:]))
        values = None
        regular = not bare.startswith(b",") and not any(mark in bare for mark in _IRREGULAR)
        if width >= 4 and regular and _has_even_lines(bare):
            values = self.numbers(card, "*NODE", np.float64)
        if values is not None and values.size == lines * width:
            rows = values.reshape(lines, width)[:, :4]
        else:
            rows = np.zeros((lines, 4))
            for k, fields in enumerate(self.fields(card)):
                rows[k, : len(fields[:4])] = [self._real(field) for field in fields[:4]]
        numbers = np.where(np.isfinite(rows[:, 0]) & (np.abs(rows[:, 0]) < 2**53), rows[:, 0], 0.5)
        wrong = np.flatnonzero(numbers != np.floor(numbers))
        if wrong.size:
            raise self.error(
                f"*NODE in {self.place(card)} has the number {rows[wrong[0], 0]:g}: expected a whole number"
            )
        return numbers.astype(np.int64), np.ascontiguousarray(rows[:, 1:])

    def numbers(self, card: Card, label: str, dtype: type) -> np.ndarray:
        """Return all numbers of a card, (k,), line ends ignored."""
        self._cursor.pos = card.begin
        return self._cursor.read_numbers_to(label, card.end, dtype)

    def _real(self, field: str) -> float:
        try:
            return float(field.upper().replace("D", "E")) if field else 0.0
        except ValueError:
            raise self.error(f"*NODE holds {quoted(field)}: expected a number") from None


def _keyword_lines(data: bytes) -> Iterator[tuple[int, int]]:
    """Byte ranges of the lines whose first letter is a single asterisk."""
    at = data.find(b"*")
    while at >= 0:
        begin, end = data.rfind(b"\n", 0, at) + 1, data.find(b"\n", at)
        end = len(data) if end < 0 else end
        if not data[begin:at].strip(b" \t") and data[at + 1 : at + 2] != b"*":
            yield begin, end
        at = data.find(b"*", end)


def _has_even_lines(text: bytes) -> bool:
    """Return True if all lines that are not empty have the same number of commas."""
    letters = np.frombuffer(b"\n" + text, np.uint8)
    marks = letters[(letters == ord("\n")) | (letters == ord(","))]
    counts = np.diff(np.flatnonzero(marks == ord("\n")), append=len(marks)) - 1
    counts = counts[:-1] if text.endswith(b"\n") else counts
    if counts.all():  # no line is empty: much faster than the general case
        return bool((counts == counts[:1]).all())
    starts = np.flatnonzero(letters == ord("\n"))
    commas = np.add.reduceat(letters == ord(","), starts, dtype=np.int64)[np.diff(starts, append=len(letters)) > 1]
    return bool((commas == commas[:1]).all())


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
