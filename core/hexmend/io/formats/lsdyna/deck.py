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
from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.coordinates import deck_files
from hexmend.io.coordinates.deck_files import DeckFile

_KEYWORD = re.compile(rb"^\*[^\n]*", re.MULTILINE)
#: Columns of a field in long format.
_LONG = 20


@dataclass(frozen=True, eq=False)
class Keyword:
    """A keyword and its lines of data.

    Parameters
    ----------
    name : str
        In upper case, without the asterisk and marks of its format.
    file : DeckFile
    at : int
        Offset of the keyword.
    begin, end : (k,) int64
        Byte range of each line of data that is neither blank nor a comment.
    is_long, has_wide_ids : bool
        Formats of the columns: all fields of 20, and ids of 10 instead of 8.
    """

    name: str
    file: DeckFile
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
        return self.file.error(f"*{self.name} in {self.file.place(self.at)} {problem}", remedy)

    def texts(self) -> list[str]:
        """Return the lines, stripped."""
        lines = zip(self.begin.tolist(), self.end.tolist(), strict=True)
        return [self.file.data[slice(*line)].decode("utf-8", errors="replace").strip() for line in lines]

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
        letters = np.frombuffer(self.file.data, np.uint8)
        commas = np.flatnonzero(letters == ord(","))
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
        padded = np.frombuffer(self.file.data + b" " * size, np.uint8)
        letters = sliding_window_view(padded, size)[begin.ravel()]
        letters[np.arange(size) >= (end - begin).reshape(-1, 1)] = ord(" ")
        texts = np.ascontiguousarray(letters).view(f"S{size}")[:, 0]
        k, f = begin.shape
        first = f * np.arange(k)
        path, place = self.file.lineage()[-1].path, self.file.place
        return Cards(path, f"*{self.name}", self.begin, texts, first, first + f, place)


def read_deck(path: Path) -> DeckFile:
    """Read a deck with all files that it includes; raises `FileError` for one that cannot be read."""
    root = DeckFile(path, read_text_bytes(path))
    for _ in keywords(root):
        pass
    return root


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes; see `hexmend.io.coordinates.deck_files.included_files`."""
    return deck_files.included_files(path, read_deck)


def keywords(root: DeckFile) -> Iterator[Keyword]:
    """Iterate over the keywords of a deck up to *END, those of included files in their places, which are opened."""
    return _keywords(root, False, False)


def _keywords(file: DeckFile, is_long: bool, has_wide_ids: bool) -> Iterator[Keyword]:
    found = list(_KEYWORD.finditer(file.data))
    letters = np.frombuffer(file.data, np.uint8)
    breaks = np.append(np.flatnonzero(letters == ord("\n")), len(letters))
    for k, match in enumerate(found):
        end = found[k + 1].start() if k + 1 < len(found) else len(file.data)
        low, high = np.searchsorted(breaks, [match.end(), end])
        starts, stops = breaks[low:high] + 1, breaks[low + 1 : high + 1]
        stops = np.minimum(stops[: len(starts)], end)
        starts = starts[: len(stops)]
        lines = [file.data[a:b] for a, b in zip(starts.tolist(), stops.tolist(), strict=True)]
        kept = np.array([line[:1] != b"$" and not line.isspace() and line != b"" for line in lines], dtype=bool)
        words = match[0].decode("latin-1").upper().replace(",", " ").split()
        name, options = words[0].lstrip("*"), words[1:]
        if name == "END":
            return
        if name == "KEYWORD":
            is_long = is_long or any(word.startswith(("LONG=Y", "LONG=S")) for word in options)
            has_wide_ids = has_wide_ids or "I10=Y" in "".join(options)
        own_long = (is_long and "-" not in options) or "+" in options
        one = Keyword(name.rstrip("+-%"), file, match.start(), starts[kept], stops[kept], own_long, has_wide_ids)
        if one.name in ("INCLUDE", "INCLUDE_TRANSFORM"):
            if one.name != "INCLUDE":
                raise one.error("moves and renumbers what it includes", "Write the deck with it expanded.")
            for included in _open(one):
                yield from _keywords(included, is_long, has_wide_ids)
        else:
            yield one


def _open(keyword: Keyword) -> Iterator[DeckFile]:
    """Open the files that *INCLUDE names, one a line; a name goes on in the next line behind " +"."""
    file, name, begin = keyword.file, "", None
    for text, start, end in zip(keyword.texts(), keyword.begin.tolist(), keyword.end.tolist(), strict=True):
        begin = start if begin is None else begin
        name += text.removesuffix("+").strip() if text.endswith(" +") else text
        if not text.endswith(" +"):
            last = begin + len(file.data[begin:end].rstrip())
            there = next((one for one in file.included if one.reference.begin == begin), None)
            yield there or file.include(name, begin, last, f"*INCLUDE in {file.place(keyword.at)}")
            name, begin = "", None
