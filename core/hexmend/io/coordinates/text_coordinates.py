"""Coordinates as decimals in a text file: the byte range of each, and their replacement.

Texts of coordinates in the style of the file: shortest decimals, or mantissa and exponent.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np

from hexmend.io.base.decimals import format_rows, parse_numbers
from hexmend.io.coordinates.edits import Edits, gather, text_lengths, write_edited
from hexmend.io.coordinates.located import CoordinatesError

_SCIENTIFIC = re.compile(rb"[+-]?[0-9]\.([0-9]+)([eE])[+-][0-9]{2,3}")
#: Decimals of a mantissa that give every float64 back.
_ENOUGH = 16


def scientific_style(words: Iterable[bytes]) -> str | None:
    """Find the format of words if all have a mantissa of one length and an exponent, such as 1.50000e+00.

    Parameters
    ----------
    words : iterable of bytes
        A sample of the file's numbers.

    Returns
    -------
    str or None
        For Python's operator %, with 16 decimals at least; None for words of another style.

    Examples
    --------
    >>> scientific_style([b"1.0000000000000000E+00", b"-2.5000000000000000E-01"])
    '%.16E'
    >>> scientific_style([b"1.5", b"1e-3"]) is None
    True
    """
    found = [_SCIENTIFIC.fullmatch(word) for word in words]
    styles = {(len(match[1]), match[2].decode()) for match in found if match}
    if not found or None in found or len(styles) > 1:
        return None
    ((decimals, letter),) = styles
    return f"%.{max(decimals, _ENOUGH)}{letter}"


def number_texts(values: np.ndarray, style: str | None = None, width: int = 0) -> bytes:
    """Format numbers, one a line.

    Parameters
    ----------
    values : (k,) float64
    style : str, optional
        From `scientific_style`; else the shortest decimals that give the same number back.
    width : int
        Most characters of a number, of which longer ones lose their last digits; 0 for no limit.

    Returns
    -------
    bytes
        k lines.

    Examples
    --------
    >>> number_texts(np.array([0.5, 2.0, -1.2345678901234567e-100]), width=20)
    b'0.5\\n2.0\\n-1.234567890123e-100\\n'
    """
    if not len(values):
        return b""
    if style is not None:
        return ((style + "\n") * len(values) % tuple(values.tolist())).encode()
    texts = format_rows(values[:, None])
    whole = np.abs(values) < 1e15
    whole[whole] = values[whole] == np.rint(values[whole])
    texts = replace_lines(texts, np.flatnonzero(whole), lambda k: b"%.1f" % values[k])
    if width:
        long = np.flatnonzero(text_lengths(texts) > width)
        texts = replace_lines(texts, long, lambda k: shortened(float(values[k]), width).encode())
    return texts


def shortened(value: float, width: int) -> str:
    """Format a number in at most `width` characters, with as many digits as fit.

    Parameters
    ----------
    value : float
    width : int
        At least 9.
    """
    for digits in range(width - 1, 0, -1):
        text = f"{value:.{digits}g}"
        if len(text) <= width:
            return text
    raise ValueError(f"{value} does not fit into {width} characters")


def replace_lines(texts: bytes, which: np.ndarray, text_of: Callable[[int], bytes]) -> bytes:
    """Replace some lines of a text; `text_of` gives the new text of a line by its index, ascending in `which`."""
    if not which.size:
        return texts
    ends = np.flatnonzero(np.frombuffer(texts, np.uint8) == ord("\n"))
    begins = np.append(0, ends[:-1] + 1)
    new = b"".join(text_of(k) + b"\n" for k in which.tolist())
    file = BytesIO()
    write_edited(file, texts, Edits(begins[which], ends[which], np.zeros(len(which), np.int64), new))
    return file.getvalue()


#: Fields that are checked at a time, which limits the memory.
_CHUNK = 1 << 17
#: Letters as NumPy parses them: exponents with e, blanks between numbers.
_NUMBER = bytes.maketrans(b"Dd,", b"ee ")
#: Numbers of the file that tell its style.
_SAMPLE = 300


@dataclass(frozen=True, eq=False)
class TextFields:
    """Byte ranges of the three coordinates of nodes, without blanks around them.

    Parameters
    ----------
    begin, end : (n, 3) int64
        Equal for a blank field.
    space : (n, 3) int64
        Blanks before the number that belong to its field.
    absent : (n, 3) bool
        True for fields that a line ends before; they are written behind a comma at `begin`.
    aligned : bool
        True for columns of a fixed width, in which a number keeps its right end.
    """

    begin: np.ndarray
    end: np.ndarray
    space: np.ndarray
    absent: np.ndarray
    aligned: bool = False

    def edits(self, changed: np.ndarray, texts: bytes) -> Edits:
        """Return the edits that write new numbers.

        Parameters
        ----------
        changed : (n, 3) bool
            The fields to write; with any of a line, those that it lacks have to be among them.
        texts : bytes
            The new numbers, one a line.
        """
        begin, end, space, absent = (part[changed] for part in (self.begin, self.end, self.space, self.absent))
        if absent.any():
            lines = texts.split(b"\n")
            texts = replace_lines(texts, np.flatnonzero(absent), lambda k: b", " + lines[k])
        padding = space
        if self.aligned:  # the number grows into its blanks, all but one
            padding = np.maximum(np.minimum(space, 1), space + end - begin - text_lengths(texts))
        order = np.argsort(begin, kind="stable")
        if (order[1:] > order[:-1]).all():
            return Edits(begin - space, end, padding, texts)
        lines = texts.split(b"\n")
        texts = b"".join(lines[k] + b"\n" for k in order.tolist())
        return Edits((begin - space)[order], end[order], padding[order], texts)


@dataclass(frozen=True, eq=False)
class TextCoordinates:
    """Coordinates of a text file, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    data : bytes
        Content of the file.
    points : (n, 3) float64
        As the reader of the format gives them.
    fields : TextFields
    width : int
        Most characters of a number; 0 for no limit.
    parsed : bool
        True if the points are those that `parse_fields` has found, so that they need no check.
    """

    data: bytes
    points: np.ndarray
    fields: TextFields
    width: int = 0
    parsed: bool = False

    def write(self, file: Path, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        with open(file, "wb") as out:
            write_edited(out, self.data, self.edits(points))
        return ()

    def edits(self, points: np.ndarray) -> Edits:
        """Return the edits that replace the coordinates that differ from `points`, (n, 3) float64."""
        changed = ~(points == self.points)  # not a number differs from everything
        if not self.parsed:
            self._check(changed)
        changed |= changed.any(axis=1)[:, None] & self.fields.absent
        return self.fields.edits(changed, number_texts(points[changed], self._style(), self.width))

    def _check(self, changed: np.ndarray) -> None:
        """Raise `CoordinatesError` unless the fields to be replaced hold the numbers that the reader has found."""
        found = parse_fields(self.data, self.fields.begin[changed], self.fields.end[changed])
        if found is None or not np.array_equal(found, self.points[changed], equal_nan=True):
            raise CoordinatesError("its layout is not one in which coordinates can be replaced")

    def _style(self) -> str | None:
        begin, end = self.fields.begin.ravel(), self.fields.end.ravel()
        step = max(1, len(begin) // _SAMPLE)
        ranges = zip(begin[::step].tolist(), end[::step].tolist(), strict=True)
        style = scientific_style(self.data[first:last] for first, last in ranges if last > first)
        return None if style is None or self.width else style


def parse_fields(data: bytes, begin: np.ndarray, end: np.ndarray) -> np.ndarray | None:
    """Parse fields of a text that are numbers or blank; None if one is something else.

    Parameters
    ----------
    data : bytes
    begin, end : (k,) int64
        Byte range of each field, without blanks around it; a blank or a comma follows, or the text ends.

    Returns
    -------
    (k,) float64 or None
        0 for a blank field.
    """
    filled = np.flatnonzero(begin < end)
    values, letters = np.zeros(len(begin)), np.frombuffer(data, np.uint8)
    for low in range(0, len(filled), _CHUNK):
        part = filled[low : low + _CHUNK]
        sizes = end[part] - begin[part]
        if end[part].max() < len(data):  # each field with the letter behind it
            text = gather(letters, begin[part], sizes + 1).tobytes().translate(_NUMBER)
        else:
            text = b" ".join(data[a:b] for a, b in zip(begin[part].tolist(), end[part].tolist(), strict=True))
            text = text.translate(_NUMBER)
        found = parse_numbers(text, np.float64)
        if found is None or len(found) != len(part):
            return None
        values[part] = found
    return values


def word_ranges(data: bytes, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Byte ranges of the words between two offsets: their begins and their ends, (k,) int64 each."""
    letters = np.zeros(end - begin + 2, bool)
    letters[1:-1] = np.frombuffer(data, np.uint8, end - begin, begin) > ord(" ")
    edges = np.flatnonzero(letters[1:] != letters[:-1]) + begin
    return edges[::2], edges[1::2]


def fields_of_words(begin: np.ndarray, end: np.ndarray) -> TextFields:
    """Fields of the words of a text between blanks, of their ranges, (n, 3) int64 each."""
    return TextFields(begin, end, np.zeros_like(begin), np.zeros(begin.shape, bool))


def blanked(data: bytes, mark: bytes) -> bytes:
    """Replace comments, from a mark to the end of the line, by as many blanks."""
    if mark not in data:
        return data
    lines = (line.partition(mark) for line in data.split(b"\n"))
    return b"\n".join(text + b" " * (len(sign) + len(comment)) for text, sign, comment in lines)
