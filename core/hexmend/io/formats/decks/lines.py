"""Lines of a deck under a keyword, cut into fields of fixed columns or between commas."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hexmend.errors import FileError
from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.coordinates.text_coordinates import TextFields
from hexmend.io.formats.decks.cards import LONGEST, Cards


@dataclass(frozen=True, eq=False)
class CardLines:
    """A keyword and its lines of data.

    Parameters
    ----------
    name : str
    files : JoinedFiles
    at : int
        Offset of the keyword in their text.
    begin, end : (k,) int64
        Byte range of each line of data.
    columns : mapping of int to int, optional
        Columns of a field, where they differ from those of the standard format; None for fields between commas alone.
    """

    name: str
    files: JoinedFiles
    at: int
    begin: np.ndarray
    end: np.ndarray
    columns: Mapping[int, int] | None = field(default_factory=dict)

    def rows(self, which: slice | np.ndarray) -> CardLines:
        """Return the keyword with some of its lines."""
        return replace(self, begin=self.begin[which], end=self.end[which])

    def filled(self) -> CardLines:
        """Return the keyword with the lines that are not blank."""
        return self.rows(np.array([bool(text) for text in self.texts()], dtype=bool))

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return self.files.root.error(f"{self.name} in {self.files.place(self.at)} {problem}", remedy)

    def texts(self) -> list[str]:
        """Return the lines, stripped."""
        lines = zip(self.begin.tolist(), self.end.tolist(), strict=True)
        return [self.files.data[slice(*line)].decode("utf-8", errors="replace").strip() for line in lines]

    def fields(self, widths: Sequence[int]) -> TextFields:
        """Return the fields of each line; `widths` are their columns in the standard format.

        Lines with commas have fields between commas.
        """
        own = np.array([(self.columns or {}).get(width, width) for width in widths])
        bounds = np.minimum(self.begin[:, None] + np.append(0, np.cumsum(own)), self.end[:, None])
        begin, end = bounds[:, :-1].copy(), bounds[:, 1:].copy()
        letters = np.frombuffer(self.files.data, np.uint8)
        commas = np.flatnonzero(letters == ord(","))
        free = np.searchsorted(commas, self.end) > np.searchsorted(commas, self.begin)
        free |= self.columns is None
        absent = end - begin < own
        begin[free], end[free], absent[free] = _comma_fields(
            letters, commas, self.begin[free], self.end[free], len(widths)
        )
        return TextFields(begin, end, absent, np.where(free[:, None], 0, own))

    def cards(self, widths: Sequence[int]) -> Cards:
        """Return the lines as cards of as many fields as `widths`, the columns in the standard format."""
        fields = self.fields(widths)
        size = min(LONGEST, int((fields.end - fields.begin).max(initial=1)))
        padded = np.frombuffer(self.files.data + b" " * size, np.uint8)
        letters = sliding_window_view(padded, size)[fields.begin.ravel()]
        letters[np.arange(size) >= (fields.end - fields.begin).reshape(-1, 1)] = ord(" ")
        texts = np.ascontiguousarray(letters).view(f"S{size}")[:, 0]
        first = len(widths) * np.arange(len(self.begin))
        path, place = self.files.root.path, self.files.place
        return Cards(path, self.name, self.begin, texts, first, first + len(widths), place)


def line_ranges(data: bytes, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Byte ranges of the lines between two offsets, without their ends, (k,) int64 each."""
    letters = np.frombuffer(data, np.uint8)[begin : max(begin, end)]
    breaks = begin + np.flatnonzero(letters == ord("\n"))
    ends = breaks if len(letters) == 0 or letters[-1] == ord("\n") else np.append(breaks, end)
    return np.append(begin, ends[:-1] + 1)[: len(ends)], ends


def keyword_lines(
    data: bytes, mark: bytes, comment: bytes, *, with_blank: bool = False
) -> Iterator[tuple[int, str, np.ndarray, np.ndarray]]:
    """Cut a deck at the lines that begin with a mark.

    Parameters
    ----------
    data : bytes
    mark : bytes
        First letter of a keyword, such as an asterisk.
    comment : bytes
        First letter of lines that are left out.
    with_blank : bool
        False if blank lines are left out too.

    Yields
    ------
    at : int
        Offset of the keyword.
    keyword : str
        Its line, without the mark.
    begin, end : (k,) int64
        Byte ranges of the lines of data that follow.
    """
    found = list(re.finditer(rb"^%s([^\n]*)" % re.escape(mark), data, re.MULTILINE))
    for k, match in enumerate(found):
        begins, ends = line_ranges(data, match.end() + 1, found[k + 1].start() if k + 1 < len(found) else len(data))
        lines = [data[a:b] for a, b in zip(begins.tolist(), ends.tolist(), strict=True)]
        kept = np.array([line[:1] != comment and (with_blank or bool(line.strip())) for line in lines], dtype=bool)
        yield match.start(), match[1].decode("latin-1").strip(), begins[kept], ends[kept]


def _comma_fields(
    letters: np.ndarray, commas: np.ndarray, start: np.ndarray, stop: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the fields of lines between commas.

    Parameters
    ----------
    letters : (l,) uint8
        The text.
    commas : (c,) int64
        Offsets of all its commas.
    start, stop : (k,) int64
        Byte range of each line.
    count : int
        Number of fields that are wanted.

    Returns
    -------
    begin, end : (k, count) int64
        Byte ranges of the fields without blanks around them; a blank field has none, where it begins.
    absent : (k, count) bool
        True for fields that a line ends before.
    """
    first = np.searchsorted(commas, start)
    n_commas = (np.searchsorted(commas, stop) - first)[:, None]
    around = np.append(commas, 0)[np.clip(first[:, None] + np.arange(-1, count), 0, len(commas))]
    absent = n_commas < np.arange(count)
    low = np.where(absent, stop[:, None], around[:, :-1] + 1)
    low[:, 0] = start
    high = np.where(n_commas > np.arange(count), around[:, 1:], stop[:, None])
    begin, end = trimmed(letters, low, np.maximum(low, high))
    blank = begin == end
    return np.where(blank, low, begin), np.where(blank, low, end), absent


def trimmed(letters: np.ndarray, begin: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return byte ranges of a text without the blanks at their ends."""
    shape, begin, end = begin.shape, begin.ravel().copy(), end.ravel().copy()
    for bound, ahead, step in (begin, 0, 1), (end, -1, -1):
        rows = np.arange(bound.size)  # those that may begin or end with a blank
        while rows.size:
            rows = rows[begin[rows] < end[rows]]
            rows = rows[letters[bound[rows] + ahead] <= ord(" ")]
            bound[rows] += step
    return begin.reshape(shape), end.reshape(shape)
