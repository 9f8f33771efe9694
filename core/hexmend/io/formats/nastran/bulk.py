"""Nastran's bulk data as cards: fields of 8 or 16 columns, or between commas, with their continuations.

Lines are cut into fields by array operations, thousands at a time; those with commas, tabs or comments one by one.

Files of a Nastran deck, joined where INCLUDE names them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from hexmend.errors import FileError
from hexmend.io.base.cursor import quoted
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles, included_files
from hexmend.io.formats.decks.cards import LONGEST, Cards

#: Lines cut into fields at a time, which bounds the memory.
_CHUNK_LINES = 65536
#: Columns of a line: name, fields, and the name of the line that continues it.
_COLUMNS = 80
#: True for bytes by which fields are not in fixed columns: tabs, commas, comments, other control codes and encodings.
_IS_IRREGULAR = np.isin(np.arange(256), [*range(10), *range(11, 32), *b",$", *range(127, 256)])

_BEGIN = re.compile(rb"^[ \t\v\f]*BEGIN", re.IGNORECASE | re.MULTILINE)


class BulkData:
    """The cards of a file.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    data : bytes
        Its content, with lines that end in "\\n".
    place : callable, optional
        place(offset) names the line of an offset.

    Attributes
    ----------
    start, end : (lines,) int64
        Offsets of the first byte of each line, and of its line end.
    """

    def __init__(self, path: Path, data: bytes, place: Callable[[int], str] | None = None):
        self._path, self._data, self._place = path, data, place
        self._padded = np.frombuffer(data + b" " * _COLUMNS, np.uint8)
        ends = np.flatnonzero(self._padded[: len(data)] == ord("\n"))
        self.end = ends if data.endswith(b"\n") else np.append(ends, len(data))
        self.start = np.concatenate([[0], self.end[:-1] + 1])

    def cards(self) -> Iterator[Cards]:
        """Iterate over the cards up to ENDDATA: in each part of the file, those of one name after another.

        Raises
        ------
        FileError
            For a continuation whose name is not the one that its card declares.
        """
        found = _BEGIN.search(self._data)
        begin = int(np.searchsorted(self.start, found.end(), "right")) if found else 0
        while begin < len(self.start):
            end = begin + _CHUNK_LINES
            while end < len(self.start) and not self._data[self.start[end] : self.start[end] + 1].isalpha():
                end += 1  # to a line that begins a card
            names, lines, texts, bounds = self._cut(begin, min(end, len(self.start)))
            begin = end
            kinds, first, which = np.unique(names, return_index=True, return_inverse=True)
            for kind in np.argsort(first).tolist():
                if kinds[kind] == b"ENDDATA":
                    return
                at = np.flatnonzero(which == kind)
                name = kinds[kind].decode("latin-1")
                yield Cards(self._path, name, lines[at], texts, bounds[at], bounds[at + 1], self.place)

    def place(self, line: int) -> str:
        """Name a line, from 1, such as "line 12", or "line 3 of nodes.bdf" in an included file."""
        return self._place(int(self.start[line - 1])) if self._place else f"line {line}"

    def _cut(self, begin: int, end: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Cut lines into cards: names, first lines from 1, fields of all cards, and their bounds (k + 1,)."""
        start, length = self.start[begin:end], self.end[begin:end] - self.start[begin:end]
        letters = sliding_window_view(self._padded, _COLUMNS)[start]
        letters[np.arange(_COLUMNS) >= length[:, None]] = ord(" ")
        irregular = np.flatnonzero(_IS_IRREGULAR[letters].any(axis=1))
        cut = [_split(self._data[self.start[begin + k] : self.end[begin + k]]) for k in irregular.tolist()]
        heads = _with_rows(_names(letters[:, :8]), irregular, [head for head, _, _ in cut])
        marks = _with_rows(_names(letters[:, 72:]), irregular, [mark for _, mark, _ in cut])
        large = np.strings.endswith(heads, b"*") | np.strings.startswith(heads, b"*")
        columns = np.ascontiguousarray(letters[:, 8:72])
        fields = columns.view("S8").astype("S16")
        fields[large, :4] = columns[large].view("S16")
        fields = _with_rows(fields, irregular, [(own + [b""] * 8)[:8] for _, _, own in cut])
        blank = (letters == ord(" ")).all(axis=1)
        blank[irregular] = [not head and not any(own) for head, _, own in cut]
        is_card = ~blank & ~np.isin(heads.astype("S1"), [b"", b"+", b"*"])
        names = np.where(is_card, np.strings.rstrip(heads, b"*"), b"")
        rows = np.flatnonzero(~blank & (np.cumsum(is_card) > 0))
        rows = rows[: 1 + (names[rows] == b"ENDDATA").argmax()] if b"ENDDATA" in names else rows
        self._check_continuations(begin + 1 + rows, heads[rows], names[rows], marks[rows])
        cards = np.flatnonzero(is_card[rows])
        n_fields = np.where(large[rows], 4, 8)
        bounds = np.concatenate([[0], np.cumsum(n_fields)])[[*cards, len(rows)]]
        texts = fields[rows][np.arange(8) < n_fields[:, None]]
        return names[rows[cards]], begin + 1 + rows[cards], texts, bounds

    def _check_continuations(self, lines: np.ndarray, heads: np.ndarray, names: np.ndarray, marks: np.ndarray) -> None:
        """Check the names of lines that continue the line before them, where both have one."""
        rows = 1 + np.flatnonzero((names[1:] == b"") & np.isin(marks[:-1].astype("S1"), [b"+", b"*"]))
        for row, mark, head in zip(rows.tolist(), marks[rows - 1].tolist(), heads[rows].tolist(), strict=True):
            declared, own = (text.lstrip(b"+*").replace(b" ", b"") for text in (mark, head))
            if declared and own and declared != own:
                card = names[:row][names[:row] != b""][-1].decode("latin-1")
                place, texts = self.place(int(lines[row])), [quoted(one.decode("latin-1")) for one in (head, declared)]
                problem = f"{place} continues a card as {texts[0]}, but {card} before it declares {texts[1]}"
                raise FileError(self._path, problem, "Put each continuation behind its card.")


def _names(letters: np.ndarray) -> np.ndarray:
    """Texts of rows of eight letters, in upper case."""
    return np.strings.upper(np.strings.strip(np.ascontiguousarray(letters).view("S8")[:, 0]))


def _with_rows(texts: np.ndarray, rows: np.ndarray, new: list) -> np.ndarray:
    """Replace rows of texts, which may become longer."""
    if not new:
        return texts
    values = np.array(new, "S")
    texts = texts.astype(np.promote_types(texts.dtype, values.dtype), copy=False)
    texts[rows] = values
    return texts


def _split(line: bytes) -> tuple[bytes, bytes, list[bytes]]:
    """Cut a line into its name, the name of the line that continues it, and the fields of its format."""
    line = line.partition(b"$")[0]
    if b"," in line:
        parts = [part.strip()[:LONGEST] for part in line.split(b",")]
        head = parts[0].upper()
        return head, b"", parts[1 : 5 if head.startswith(b"*") or head.endswith(b"*") else 9]
    line = line.expandtabs(8)
    head = line[:8].strip().upper()
    width = 16 if head.startswith(b"*") or head.endswith(b"*") else 8
    return head, line[72:80].strip().upper(), [line[k : k + width].strip() for k in range(8, 72, width)]


_INCLUDE = re.compile(rb"^[ \t]*INCLUDE[ \t,=]*('[^']*'|\"[^\"]*\"|[^\s$,]+)[^\n]*", re.IGNORECASE | re.MULTILINE)
_END = re.compile(rb"^ENDDATA[^\n]*\n?", re.IGNORECASE | re.MULTILINE)


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions, _END)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for found in _INCLUDE.finditer(data):
        name = found[1].strip(found[1][:1]) if found[1][:1] in (b"'", b'"') else found[1]
        text = re.sub(rb"\s*\n\s*", b"", name).decode("utf-8", errors="replace")
        yield Inclusion(found.start(), *found.span(), "INCLUDE", [(text, *found.span(1))])


#: included_files_of(path) finds the files that a deck includes.
included_files_of = partial(included_files, join)
