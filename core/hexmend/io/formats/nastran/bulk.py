"""Nastran's bulk data as cards: fields of 8 or 16 columns, or between commas, with their continuations.

Blocks of consecutive cards of one name and field width, whose fields are cut out by array operations.

Cards in free fields, or with comments or blank lines inside, are left to `hexmend.io.formats.nastran.bulk`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hexmend.errors import FileError
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import runs

#: Shorter runs of cards are read one by one.
_MIN_CARDS = 32
#: Lines cut into fields at a time, which bounds the memory.
_CHUNK_LINES = 65536
#: Class of each byte: 0 blank, 1 plain text, 2 not allowed in fixed fields (tabs, commas, comments, other encodings).
_BYTE_CLASS = np.where(np.arange(256) > ord(" "), 1, 0).astype(np.uint8)
_BYTE_CLASS[[*range(10), *range(11, 32), *b",$", *range(127, 256)]] = 2


@dataclass(frozen=True, eq=False)
class CardBlock:
    """Consecutive cards of one name.

    Parameters
    ----------
    first, last : int
        Their lines, from 0: first to last - 1.
    name : str
    fields : (cards, fields) array of bytes
        Their fields after the name, continuations joined.
    """

    first: int
    last: int
    name: str
    fields: np.ndarray


class Lines:
    """The lines of a file.

    Parameters
    ----------
    data : bytes
        Its content, with lines that end in "\\n".
    """

    def __init__(self, data: bytes):
        self._data = data
        self._padded = np.frombuffer(data + b" " * 64, np.uint8)
        self._bytes = self._padded[: len(data)]
        ends = np.flatnonzero(self._bytes == ord("\n"))
        if not data.endswith(b"\n"):
            ends = np.append(ends, len(data))
        self.start = np.concatenate([[0], ends[:-1] + 1])
        self.end = ends

    def __len__(self) -> int:
        return len(self.start)

    def text(self, first: int, last: int) -> list[str]:
        """Return the lines first to last - 1."""
        return self._data[self.start[first] : self.end[last - 1]].decode("latin-1").split("\n") if last > first else []

    def card_blocks(self, begin: int, names: Collection[str]) -> list[CardBlock]:
        """Find the blocks of cards of these names from line `begin` on, in order."""
        if begin >= len(self):
            return []
        heads = np.char.strip(np.concatenate([self._fields(chunk, 0, 8) for chunk in self._chunks(begin)])[:, 0])
        letters = heads.astype("S1").view(np.uint8)
        large = (letters == ord("*")) | np.char.endswith(heads, b"*")
        line_class = np.maximum.reduceat(_BYTE_CLASS[self._bytes], self.start[begin:])
        irregular = line_class != 1
        continued = (line_class == 0) | (letters == 0) | np.isin(letters, [*b"+*$"])
        cards = np.flatnonzero(~continued)
        if not len(cards):
            return []
        counts = np.diff(np.append(cards, len(heads)))
        irregular |= large != np.repeat(large[cards], counts) if cards[0] == 0 else True
        irregular = np.logical_or.reduceat(irregular, cards)
        kinds, which = np.unique(heads[cards], return_inverse=True)
        known = [kind.decode("latin-1").rstrip("*") in names and not kind.startswith(b"*") for kind in kinds]
        blocks = []
        for run in runs(which, counts, irregular):
            if run.stop - run.start < _MIN_CARDS or irregular[run.start] or not known[which[run.start]]:
                continue
            first, count = begin + int(cards[run.start]), int(counts[run.start])
            last = first + count * (run.stop - run.start)
            width = 16 if large[cards[run.start]] else 8
            fields = np.concatenate([self._fields(chunk, 8, width) for chunk in self._chunks(first, last)])
            name = kinds[which[run.start]].decode("latin-1").rstrip("*")
            blocks.append(CardBlock(first, last, name, fields.reshape(run.stop - run.start, -1)))
        return blocks

    def _chunks(self, first: int, last: int | None = None) -> list[range]:
        last = len(self) if last is None else last
        return [range(k, min(k + _CHUNK_LINES, last)) for k in range(first, last, _CHUNK_LINES)]

    def _fields(self, lines: range, left: int, width: int) -> np.ndarray:
        """Fields of lines, (lines, fields) of bytes: the name (left = 0), or the 64 columns after it (left = 8)."""
        start, end = self.start[lines.start : lines.stop] + left, self.end[lines.start : lines.stop]
        columns = 64 if left else 8
        letters = sliding_window_view(self._padded, columns)[np.minimum(start, end)]
        letters[np.arange(columns) >= (end - start)[:, None]] = ord(" ")
        return letters.view(f"S{width}")


def natural_numbers(fields: np.ndarray) -> np.ndarray | None:
    """Parse natural numbers, 0 for blanks; return None where a field holds anything else.

    Parameters
    ----------
    fields : array of bytes

    Returns
    -------
    int64 array of the same shape, or None

    Examples
    --------
    >>> natural_numbers(np.array([b"12      ", b"      7", b""]))
    array([12,  7,  0])
    """
    letters = np.ascontiguousarray(fields).view(np.uint8).reshape(*fields.shape, -1)
    values, begun, ended = (np.zeros(fields.shape, kind) for kind in (np.int64, bool, bool))
    for k in range(letters.shape[-1]):
        digit = letters[..., k] - np.uint8(ord("0"))  # bytes below "0" wrap round to more than 9
        is_digit = digit < 10
        if (is_digit & ended).any() or not (is_digit | (letters[..., k] == ord(" ")) | (letters[..., k] == 0)).all():
            return None
        values = np.where(is_digit, 10 * values + digit, values)
        ended |= begun & ~is_digit
        begun |= is_digit
    return values


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
