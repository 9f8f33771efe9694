"""Replacement of parts of a text by new numbers, without a loop over the parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

#: Bytes of the text that are edited at a time, which limits the memory.
WINDOW = 1 << 21


@dataclass(frozen=True, eq=False)
class Edits:
    """Parts of a text and the texts that replace them.

    Parameters
    ----------
    begin, end : (k,) int64
        Byte range of each part; ascending, without overlaps.
    padding : (k,) int64
        Number of blanks before each new text.
    texts : bytes
        The new texts, each followed by a line end.
    """

    begin: np.ndarray
    end: np.ndarray
    padding: np.ndarray
    texts: bytes

    def __len__(self) -> int:
        return len(self.begin)


def text_lengths(texts: bytes) -> np.ndarray:
    """Length of each line of a text whose last line has an end too, (k,) int64."""
    ends = np.flatnonzero(np.frombuffer(texts, np.uint8) == ord("\n"))
    return np.diff(ends, prepend=-1) - 1


def write_edited(file: BinaryIO, data: bytes, edits: Edits, window: int = WINDOW) -> None:
    """Write a text with some of its parts replaced.

    Parameters
    ----------
    file : BinaryIO
    data : bytes
        The text.
    edits : Edits
    window : int
        Bytes of the text that are edited at a time.
    """
    lengths = text_lengths(edits.texts)
    text_begin = np.cumsum(lengths + 1) - lengths - 1
    at, first = 0, np.flatnonzero(np.diff(edits.begin // window, prepend=-1))
    view, texts = memoryview(data), np.frombuffer(edits.texts, np.uint8)
    for low, high in zip(first.tolist(), [*first[1:].tolist(), len(edits)], strict=False):
        here = slice(low, high)
        begin, end = int(edits.begin[low]), int(edits.end[high - 1])
        file.write(view[at:begin])
        # A pool of bytes: the part of the text, blanks, and the new texts. Each edit gives three pieces of it.
        given = np.frombuffer(data, np.uint8, end - begin, begin) if end > begin else np.empty(0, np.uint8)
        blanks = np.full(int(edits.padding[here].max()), ord(" "), np.uint8)
        own = texts[text_begin[low] : text_begin[high - 1] + lengths[high - 1]]
        pool = np.concatenate([given, blanks, own])
        before = np.concatenate([[begin], edits.end[low : high - 1]])
        shift = len(given) + len(blanks) - text_begin[low]
        starts = [before - begin, np.full(high - low, len(given)), text_begin[here] + shift]
        sizes = [edits.begin[here] - before, edits.padding[here], lengths[here]]
        file.write(gather(pool, np.column_stack(starts).ravel(), np.column_stack(sizes).ravel()).tobytes())
        at = end
    file.write(view[at:])


def gather(pool: np.ndarray, starts: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Concatenate pieces of an array, (k,) starts and sizes each."""
    offsets = np.cumsum(sizes) - sizes
    return pool[np.repeat(starts - offsets, sizes) + np.arange(int(sizes.sum()))]
