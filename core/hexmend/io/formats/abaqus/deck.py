"""An Abaqus input deck as cards: a keyword with its options, and the lines of data behind it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted

_KEYWORD = re.compile(rb"^[ \t]*\*(?!\*)[^\n]*", re.MULTILINE)
_COMMENT = re.compile(rb"^[ \t]*\*\*[^\n]*", re.MULTILINE)
_FIELD = re.compile(r'(?:[^,"]|"[^"]*"?)+')
_EMPTY = re.compile(rb",[ \t]*,|^[ \t]*,|[dD]", re.MULTILINE)


@dataclass(frozen=True)
class Card:
    """A keyword and its data.

    Parameters
    ----------
    name : str
        In upper case, such as "NODE".
    options : dict
        By name in upper case; "" for those without a value.
    begin, end : int
        The bytes of its data.
    line : int
        Where its keyword is.
    """

    name: str
    options: dict[str, str]
    begin: int
    end: int
    line: int


class Deck:
    """The cards of a file, and what stands in their lines.

    Parameters
    ----------
    path : Path
    data : bytes
    """

    def __init__(self, path: Path, data: bytes):
        if b"\r" in data:
            data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
        if b"**" in data:
            data = _COMMENT.sub(b"", data)
        self.path, self.data = path, data
        self._numbers = ByteCursor(path, data.replace(b",", b" "))

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """The error to raise."""
        return FileError(self.path, problem, remedy)

    def cards(self) -> Iterator[Card]:
        """All cards in order."""
        line, seen, skip_to = 1, 0, 0
        found = list(_KEYWORD.finditer(self.data))
        for k, one in enumerate(found):
            if one.start() < skip_to:
                continue
            line += self.data.count(b"\n", seen, one.start())
            seen = one.start()
            head, begin = one.group(), one.end() + 1
            while head.rstrip().endswith(b",") and begin < len(self.data):  # goes on in the next line
                after = self.data.find(b"\n", begin)
                after = len(self.data) if after < 0 else after
                head, begin = head + self.data[begin:after], after + 1
            skip_to = begin
            end = found[k + 1].start() if k + 1 < len(found) else len(self.data)
            name, options = _parsed(head.decode("utf-8", errors="replace"))
            yield Card(name, options, min(begin, max(end, one.end())), max(end, one.end()), line)

    def rows(self, card: Card) -> list[list[str]]:
        """The fields of each line that is not blank; a comma at its end is passed over."""
        text = self.data[card.begin : card.end].decode("utf-8", errors="replace")
        lines = (line.strip() for line in text.split("\n"))
        return [[field.strip() for field in _fields(line.removesuffix(","))] for line in lines if line]

    def nodes(self, card: Card) -> tuple[np.ndarray, np.ndarray]:
        """Numbers (k,) int64 and coordinates (k, 3) float64 of the nodes of a card; what is left blank is 0."""
        text = self.data[card.begin : card.end]
        first = text.lstrip().split(b"\n", 1)[0].strip().removesuffix(b",")
        width = first.count(b",") + 1 if first else 0
        lines = len(text.split()) and sum(1 for line in text.split(b"\n") if line.strip())
        values = None
        if width >= 4 and not _EMPTY.search(text):
            values = self.numbers(card, "*NODE", np.float64)
        if values is not None and values.size == lines * width:
            rows = values.reshape(lines, width)[:, :4]
        else:
            rows = np.zeros((lines, 4))
            for k, fields in enumerate(self.rows(card)):
                rows[k, : len(fields[:4])] = [self._real(field) for field in fields[:4]]
        numbers = np.where(np.isfinite(rows[:, 0]) & (np.abs(rows[:, 0]) < 2**53), rows[:, 0], 0.5)
        wrong = np.flatnonzero(numbers != np.floor(numbers))
        if wrong.size:
            raise self.error(f"*NODE in line {card.line} has the number {rows[wrong[0], 0]:g}: expected a whole number")
        return numbers.astype(np.int64), np.ascontiguousarray(rows[:, 1:])

    def numbers(self, card: Card, what: str, dtype: type) -> np.ndarray:
        """All numbers of a card, wherever its lines end."""
        self._numbers.pos = card.begin
        return self._numbers.read_numbers_to(what, card.end, dtype)

    def _real(self, field: str) -> float:
        try:
            return float(field.upper().replace("D", "E")) if field else 0.0
        except ValueError:
            raise self.error(f"*NODE holds {quoted(field)}: expected a number") from None


def _parsed(head: str) -> tuple[str, dict[str, str]]:
    fields = _fields(head.strip().lstrip("*").strip())
    options = {}
    for field in fields[1:]:
        key, _, value = field.partition("=")
        options[" ".join(key.upper().split())] = value.strip()
    return " ".join((fields[0] if fields else "").upper().split()), options


def _fields(line: str) -> list[str]:
    """Parts between commas, those within quotes apart."""
    if '"' not in line:
        return line.split(",")
    return _FIELD.findall(line)
