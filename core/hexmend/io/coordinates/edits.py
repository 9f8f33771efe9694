"""Replacement of parts of a text by new ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

#: Edits whose places are Python's numbers at a time, which limits the memory.
_CHUNK = 1 << 16


@dataclass(frozen=True, eq=False)
class Edits:
    """Parts of a text and the texts that replace them.

    Parameters
    ----------
    begin, end : (k,) int64
        Byte range of each part; without overlaps.
    texts : list of bytes
        The new texts.
    """

    begin: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    end: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    texts: list[bytes] = field(default_factory=list)

    @classmethod
    def of(cls, rows: list[tuple[int, int, bytes]]) -> Edits:
        """Make the edits of rows of a begin, an end and a text, in any order."""
        begin, end = np.array([row[:2] for row in rows], np.int64).reshape(-1, 2).T
        return cls(begin, end, [text for *_, text in rows]).in_order()

    def __len__(self) -> int:
        return len(self.begin)

    def in_order(self) -> Edits:
        """Return the edits in the order of the text."""
        if (self.begin[1:] >= self.begin[:-1]).all():
            return self
        order = np.argsort(self.begin, kind="stable")
        return Edits(self.begin[order], self.end[order], [self.texts[k] for k in order.tolist()])

    def write(self, path: Path, data: bytes) -> None:
        """Write a text with these parts replaced to a file."""
        with open(path, "wb") as out:
            out.writelines(edited(data, self))


def edited(data: bytes, edits: Edits) -> Iterator[bytes | memoryview]:
    """Yield a text piece by piece, with some of its parts replaced, in order."""
    view, at = memoryview(data), 0
    for low in range(0, len(edits), _CHUNK):
        part = slice(low, low + _CHUNK)
        for begin, end, text in zip(
            edits.begin[part].tolist(), edits.end[part].tolist(), edits.texts[part], strict=True
        ):
            yield view[at:begin]
            yield text
            at = end
    yield view[at:]
