"""Many cards of Nastran's bulk data at a time: stretches of cards of one name in columns of one width.

What is not in fixed columns, or has comments or blank lines inside, is left to `hexmend.io.formats.nastran.bulk`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hexmend.io.base.numbering import runs

#: Fewer cards than these are not worth it; and how many lines are cut into columns at a time.
_FEW, _LINES = 32, 65536
#: What a byte makes of its line: 0 nothing, 1 something, 2 something else than columns of plain text.
_HOLDS = np.where(np.arange(256) > ord(" "), 1, 0).astype(np.uint8)
_HOLDS[[*range(10), *range(11, 32), *b",$", *range(127, 256)]] = 2


@dataclass(frozen=True, eq=False)
class Stretch:
    """Cards of one name.

    Parameters
    ----------
    first, last : int
        The lines that they are, from 0: from the first to that before the last.
    name : str
    words : (cards, fields) array of bytes
        Their fields, continuations joined.
    """

    first: int
    last: int
    name: str
    words: np.ndarray


class Lines:
    """The lines of a file.

    Parameters
    ----------
    data : bytes
        With "\\n" at the ends of lines.
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
        """Lines from the first to that before the last."""
        return self._data[self.start[first] : self.end[last - 1]].decode("latin-1").split("\n") if last > first else []

    def stretches(self, begin: int, names: Collection[str]) -> list[Stretch]:
        """Stretches of cards of some names from a line on, in order."""
        if begin >= len(self):
            return []
        heads = np.char.strip(np.concatenate([self._columns(part, 0, 8) for part in self._parts(begin)])[:, 0])
        letters = heads.astype("S1").view(np.uint8)
        large = (letters == ord("*")) | np.char.endswith(heads, b"*")
        holds = np.maximum.reduceat(_HOLDS[self._bytes], self.start[begin:])
        odd = holds != 1
        goes_on = (holds == 0) | (letters == 0) | (letters == ord("+")) | (letters == ord("*")) | (letters == ord("$"))
        cards = np.flatnonzero(~goes_on)
        if not len(cards):
            return []
        counts = np.diff(np.append(cards, len(heads)))
        odd |= large != np.repeat(large[cards], counts) if cards[0] == 0 else True
        odd = np.logical_or.reduceat(odd, cards)
        kinds, which = np.unique(heads[cards], return_inverse=True)
        known = [kind.decode("latin-1").rstrip("*") in names and not kind.startswith(b"*") for kind in kinds]
        found = []
        for run in runs(which, counts, odd):
            if run.stop - run.start < _FEW or odd[run.start] or not known[which[run.start]]:
                continue
            first, count = begin + int(cards[run.start]), int(counts[run.start])
            last = first + count * (run.stop - run.start)
            width = 16 if large[cards[run.start]] else 8
            words = np.concatenate([self._columns(part, 8, width) for part in self._parts(first, last)])
            name = kinds[which[run.start]].decode("latin-1").rstrip("*")
            found.append(Stretch(first, last, name, words.reshape(run.stop - run.start, -1)))
        return found

    def _parts(self, first: int, last: int | None = None) -> list[range]:
        last = len(self) if last is None else last
        return [range(k, min(k + _LINES, last)) for k in range(first, last, _LINES)]

    def _columns(self, lines: range, left: int, width: int) -> np.ndarray:
        """Fields of lines, the name's alone or the 64 columns behind it, (lines, fields) of bytes."""
        start, end = self.start[lines.start : lines.stop] + left, self.end[lines.start : lines.stop]
        columns = 64 if left else 8
        letters = sliding_window_view(self._padded, columns)[np.minimum(start, end)]
        letters[np.arange(columns) >= (end - start)[:, None]] = ord(" ")
        return letters.view(f"S{width}")


def wholes(words: np.ndarray) -> np.ndarray | None:
    """Natural numbers, 0 for blanks; None unless all words are such.

    >>> wholes(np.array([b"12      ", b"      7", b""]))
    array([12,  7,  0])
    """
    letters = np.ascontiguousarray(words).view(np.uint8).reshape(*words.shape, -1)
    values, begun, ended = (np.zeros(words.shape, kind) for kind in (np.int64, bool, bool))
    for k in range(letters.shape[-1]):
        digit = letters[..., k] - np.uint8(ord("0"))  # others wrap round
        here = digit < 10
        if (here & ended).any() or not (here | (letters[..., k] == ord(" ")) | (letters[..., k] == 0)).all():
            return None
        values = np.where(here, 10 * values + digit, values)
        ended |= begun & ~here
        begun |= here
    return values
