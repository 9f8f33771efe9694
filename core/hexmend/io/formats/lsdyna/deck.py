"""Deck of LS-DYNA as blocks: a keyword, and the lines of data that follow it, cut into fields."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hexmend.errors import FileError
from hexmend.io.base.cards import LONGEST, Cards
from hexmend.io.coordinates import joined_files
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles

_KEYWORD = re.compile(rb"^\*[^\n]*", re.MULTILINE)
_INCLUDE = re.compile(rb"^\*INCLUDE[ \t]*\n((?:(?!\*)[^\n]*(?:\n|\Z))*)", re.IGNORECASE | re.MULTILINE)
#: Name of a file in a line that is no comment; it goes on in the next line behind " +".
_NAME = re.compile(rb"^(?!\$)[ \t]*(\S(?:[^\n]* \+[ \t]*\n)*[^\n]*)", re.MULTILINE)
_END = re.compile(rb"^\*END[ \t]*$", re.IGNORECASE | re.MULTILINE)
#: Columns of a field in long format.
_LONG = 20


@dataclass(frozen=True, eq=False)
class Keyword:
    """A keyword and its lines of data.

    Parameters
    ----------
    name : str
        In upper case, without the asterisk and marks of its format.
    files : JoinedFiles
    at : int
        Offset of the keyword in their text.
    begin, end : (k,) int64
        Byte range of each line of data that is neither blank nor a comment.
    is_long, has_wide_ids : bool
        Formats of the columns: all fields of 20, and ids of 10 instead of 8.
    """

    name: str
    files: JoinedFiles
    at: int
    begin: np.ndarray
    end: np.ndarray
    is_long: bool
    has_wide_ids: bool

    def rows(self, which: slice | np.ndarray) -> Keyword:
        """Return the keyword with some of its lines."""
        return replace(self, begin=self.begin[which], end=self.end[which])

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return self.files.root.error(f"*{self.name} in {self.files.place(self.at)} {problem}", remedy)

    def texts(self) -> list[str]:
        """Return the lines, stripped."""
        lines = zip(self.begin.tolist(), self.end.tolist(), strict=True)
        return [self.files.data[slice(*line)].decode("utf-8", errors="replace").strip() for line in lines]

    def ranges(self, widths: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Byte ranges of the fields of each line, (k, f) int64 each, and True for lines of fields between commas, (k,).

        `widths` are the columns of the fields in standard format.
        """
        if self.is_long:
            widths = (_LONG,) * len(widths)
        elif self.has_wide_ids:
            widths = tuple(10 if width == 8 else width for width in widths)
        columns = np.concatenate([[0], np.cumsum(widths)])
        bounds = np.minimum(self.begin[:, None] + columns, self.end[:, None])
        begin, end = bounds[:, :-1].copy(), bounds[:, 1:].copy()
        commas = np.flatnonzero(np.frombuffer(self.files.data, np.uint8) == ord(","))
        first, last = np.searchsorted(commas, self.begin), np.searchsorted(commas, self.end)
        for row in np.flatnonzero(last > first).tolist():
            marks = [int(self.begin[row]) - 1, *commas[first[row] : last[row]].tolist(), int(self.end[row])]
            marks += [marks[-1]] * len(widths)
            begin[row] = np.minimum(np.array(marks[: len(widths)]) + 1, self.end[row])
            end[row] = marks[1 : len(widths) + 1]
        return begin, end, last > first

    def cards(self, widths: tuple[int, ...]) -> Cards:
        """Return the lines as cards of as many fields as `widths`, the columns in standard format."""
        begin, end, _ = self.ranges(widths)
        size = min(LONGEST, int((end - begin).max(initial=1)))
        padded = np.frombuffer(self.files.data + b" " * size, np.uint8)
        letters = sliding_window_view(padded, size)[begin.ravel()]
        letters[np.arange(size) >= (end - begin).reshape(-1, 1)] = ord(" ")
        texts = np.ascontiguousarray(letters).view(f"S{size}")[:, 0]
        first = len(widths) * np.arange(len(begin))
        path, place = self.files.root.path, self.files.place
        return Cards(path, f"*{self.name}", self.begin, texts, first, first + len(widths), place)


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions, _end)


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes."""
    return joined_files.included_files(path, join)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for found in _INCLUDE.finditer(data):
        names = []
        for one in _NAME.finditer(data, *found.span(1)):
            name = re.sub(rb" \+[ \t]*\n[ \t]*", b"", one[1]).rstrip()
            names.append((name.decode("utf-8", errors="replace"), one.start(1), one.start(1) + len(one[1].rstrip())))
        yield Inclusion(found.start(), *found.span(), "*INCLUDE", names)


def _end(data: bytes) -> int:
    found = _END.search(data)
    return found.start() if found else len(data)


def keywords(files: JoinedFiles) -> Iterator[Keyword]:
    """Iterate over the keywords of a deck."""
    data, is_long, has_wide_ids = files.data, False, False
    found = list(_KEYWORD.finditer(data))
    breaks = np.append(np.flatnonzero(np.frombuffer(data, np.uint8) == ord("\n")), len(data))
    for k, match in enumerate(found):
        end = found[k + 1].start() if k + 1 < len(found) else len(data)
        low, high = np.searchsorted(breaks, [match.end(), end])
        starts, stops = breaks[low:high] + 1, np.minimum(breaks[low + 1 : high + 1], end)
        starts = starts[: len(stops)]
        lines = [data[a:b] for a, b in zip(starts.tolist(), stops.tolist(), strict=True)]
        kept = np.array([line[:1] != b"$" and bool(line.strip()) for line in lines], dtype=bool)
        name, *options = match[0].decode("latin-1").upper().replace(",", " ").lstrip("*").split() or [""]
        if name == "KEYWORD":
            is_long = any(word.startswith(("LONG=Y", "LONG=S")) for word in options)
            has_wide_ids = "I10=Y" in "".join(options)
        own = (is_long and "-" not in options) or "+" in options
        one = Keyword(name.rstrip("+-%"), files, match.start(), starts[kept], stops[kept], own, has_wide_ids)
        if one.name.startswith("INCLUDE_TRANSFORM"):
            raise one.error("moves and renumbers what it includes", "Write the deck with it expanded.")
        yield one
