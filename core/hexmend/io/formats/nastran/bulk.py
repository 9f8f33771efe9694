"""Nastran's bulk data as cards: fields of 8 or 16 columns, or between commas, with their continuations."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import quoted
from hexmend.io.formats.nastran.card_blocks import CardBlock, Lines

#: Line (from 1), name and fields of a card.
Card = tuple[int, str, list[str]]

_BEGIN = re.compile(rb"^[ \t\v\f]*BEGIN", re.IGNORECASE | re.MULTILINE)
_EXPONENT = re.compile(r"([+-]?[0-9.]+)(?:[ED]([+-]?)|([+-]))([0-9]+)", re.IGNORECASE)

#: Fields of a line after its name: eight of 8 columns, or four of 16.
_SMALL_FIELDS = [slice(k, k + 8) for k in range(8, 72, 8)]
_LARGE_FIELDS = [slice(k, k + 16) for k in range(8, 72, 16)]


class BulkData:
    """The cards of a file.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    data : bytes
        Its content, with lines that end in "\\n".
    """

    def __init__(self, path: Path, data: bytes):
        self.path, self.lines = path, Lines(data)
        found = _BEGIN.search(data)
        self._begin = int(np.searchsorted(self.lines.start, found.end(), "right")) if found else 0

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return FileError(self.path, problem, remedy)

    def cards_and_blocks(self, names: Collection[str]) -> Iterator[Card | CardBlock]:
        """Iterate over the cards up to ENDDATA in order; cards of these names come as blocks where possible."""
        line = self._begin
        for block in self.lines.card_blocks(line, names):
            for card in self.cards(line, block.first):
                yield card
                if card[1] == "ENDDATA":
                    return
            yield block
            line = block.last
        yield from self.cards(line, len(self.lines))

    def cards(self, first: int, last: int) -> Iterator[Card]:
        """Iterate over the cards of lines first to last - 1, up to ENDDATA, with stripped fields."""
        card_line, name, fields, announced = 0, "", [], ""
        for k, line in enumerate(self.lines.text(first, last), first):
            if "$" in line:
                line = line[: line.index("$")]
            if not line or line.isspace():
                continue
            head, own = _split_line(line)
            before, announced = announced, _continuation(line)
            if head[:1] in ("", "+", "*"):  # continues the card before
                if name:
                    own_name = head.lstrip("+*").replace(" ", "")
                    if own_name and before and own_name != before:
                        problem = f"line {k + 1} continues a card as {quoted(head)}, but {name} before it declares"
                        remedy = "Put each continuation behind its card."
                        raise self.error(f"{problem} {quoted(before)}", remedy)
                    fields += own
                continue
            if name:
                yield card_line, name, fields
            card_line, name, fields = k + 1, head, own
            if name == "ENDDATA":
                break
        if name:
            yield card_line, name, fields

    def integer(self, word: str, line: int, name: str) -> int:
        """Parse a whole number, 0 for a blank field; `FileError` names the card and its line."""
        if not word:
            return 0
        if word.isdecimal() and word.isascii() and len(word) < 19:
            return int(word)
        digits = word[1:] if word[0] in "+-" else word
        if not (digits.isascii() and digits.isdigit() and len(digits) < 19):
            raise self.error(f"{name} in line {line} holds {quoted(word)}: expected a whole number")
        return int(word)

    def real(self, word: str, line: int, name: str) -> float:
        """Parse a real number, 0 for a blank field; its exponent may have the letter D or none: 1.5D3, 1.5-3."""
        try:
            return float(word or 0)
        except ValueError:
            pass
        found = _EXPONENT.fullmatch(word)
        try:
            return float(f"{found[1]}e{found[2] or found[3] or ''}{found[4]}" if found else word)
        except ValueError:
            raise self.error(f"{name} in line {line} holds {quoted(word)}: expected a number") from None


def _continuation(line: str) -> str:
    """Return the name in columns 73 to 80 that the line that continues a card has too, without its mark."""
    if "," in line:
        return ""
    text = (line.expandtabs(8) if "\t" in line else line)[72:80].strip().upper()
    return text.lstrip("+*").replace(" ", "") if text[:1] in ("+", "*") else ""


def _split_line(line: str) -> tuple[str, list[str]]:
    """Name and fields of a line, in the number of fields of its format."""
    if "," in line:
        parts = [part.strip() for part in line.split(",")]
        head = parts[0].upper()
        width = 4 if head.endswith("*") or head.startswith("*") else 8
        own = parts[1 : 1 + width] + [""] * (width - len(parts[1 : 1 + width]))
    else:
        line = line.expandtabs(8) if "\t" in line else line
        head = line[:8].strip().upper()
        large = head.endswith("*") or head.startswith("*")
        own = [line[part].strip() for part in (_LARGE_FIELDS if large else _SMALL_FIELDS)]
    return (head.rstrip("*") if len(head) > 1 and not head.startswith("*") else head), own
