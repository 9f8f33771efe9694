"""Blocks of consecutive cards of one name and field width, whose fields are cut out by array operations.

Cards in free fields, or with comments or blank lines inside, are left to `hexmend.io.formats.nastran.bulk`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

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
