"""Coordinates as decimals in a text file: the byte range of each, and their replacement.

Texts of coordinates are the shortest decimals.

Replacement of parts of a text by new ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from dataclasses import fields as dataclass_fields
from pathlib import Path

import numpy as np

from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.storage.atomic import AtomicFiles

#: Edits whose places are Python's numbers at a time, which limits the memory.
_EDITS_AT_A_TIME = 1 << 16


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
    for low in range(0, len(edits), _EDITS_AT_A_TIME):
        part = slice(low, low + _EDITS_AT_A_TIME)
        for begin, end, text in zip(
            edits.begin[part].tolist(), edits.end[part].tolist(), edits.texts[part], strict=True
        ):
            yield view[at:begin]
            yield text
            at = end
    yield view[at:]


def number_texts(values: np.ndarray, width: int = 0) -> list[bytes]:
    """Format numbers as the shortest decimals that give the same number back.

    Parameters
    ----------
    values : (k,) float64
    width : int
        Most characters of a number, of which longer ones lose their last digits; 0 for no limit.

    Examples
    --------
    >>> number_texts(np.array([0.5, 2.0, -1.2345678901234567e-100]), width=20)
    [b'0.5', b'2.0', b'-1.234567890123e-100']
    """
    texts = [repr(value).encode() for value in values.tolist()]
    for k, text in enumerate(texts):
        if width and len(text) > width:
            texts[k] = shortened(float(values[k]), width).encode()
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


#: Fields that are checked at a time, which limits the memory.
_CHUNK = 1 << 17
#: Longest field that is parsed together with others, in bytes.
_WIDEST = 64


@dataclass(frozen=True, eq=False)
class TextFields:
    """Byte ranges of fields of lines, such as the three coordinates of nodes; without blanks where words are read.

    Parameters
    ----------
    begin, end : (n, f) int64
        Equal for a blank field.
    absent : (n, f) bool
        True for fields that a line ends before; they are written behind a comma at `begin`.
    columns : (n, f) int64
        Width of fields in fixed columns, whose numbers stand at the right; 0 for fields between commas or blanks.
    """

    begin: np.ndarray
    end: np.ndarray
    absent: np.ndarray
    columns: np.ndarray

    @classmethod
    def joined(cls, parts: Sequence[TextFields], which: slice = slice(None)) -> TextFields:
        """Join the fields of lines one below the other, some in each line."""
        arrays = ([getattr(part, one.name)[:, which] for part in parts] for one in dataclass_fields(cls))
        return cls(*map(np.concatenate, arrays))

    def edits(self, changed: np.ndarray, texts: list[bytes]) -> Edits:
        """Return the edits that write new numbers.

        Parameters
        ----------
        changed : (n, 3) bool
            The fields to write; with any of a line, those that it lacks have to be among them.
        texts : list of bytes
            The new numbers.
        """
        absent, columns = self.absent[changed].tolist(), self.columns[changed].tolist()
        for k, (is_absent, width) in enumerate(zip(absent, columns, strict=True)):
            texts[k] = b", " + texts[k] if is_absent and not width else texts[k].rjust(width)
        return Edits(self.begin[changed], self.end[changed], texts).in_order()


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
        Of words.
    """

    data: bytes
    points: np.ndarray
    fields: TextFields

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        self.edits(points).write(files.add(target), self.data)
        return ()

    def edits(self, points: np.ndarray) -> Edits:
        """Return the edits that replace the coordinates that differ from `points`, (n, 3) float64."""
        changed = ~(points == self.points)  # not a number differs from everything
        found = parse_fields(self.data, self.fields.begin[changed], self.fields.end[changed])
        if found is None or not np.array_equal(found, self.points[changed], equal_nan=True):
            raise CoordinatesError("its layout is not one in which coordinates can be replaced")
        return self.fields.edits(changed, number_texts(points[changed]))


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
    values, size, letters = np.zeros(len(begin)), end - begin, np.frombuffer(data, np.uint8)
    try:
        for row in np.flatnonzero(size > _WIDEST).tolist():
            values[row] = float(data[begin[row] : end[row]])
        filled = np.flatnonzero((size > 0) & (size <= _WIDEST))
        for low in range(0, len(filled), _CHUNK):
            part = filled[low : low + _CHUNK]
            columns = np.arange(size[part].max())
            texts = letters.take(begin[part, None] + columns, mode="clip")
            texts[columns >= size[part, None]] = 0
            texts[(texts == ord("D")) | (texts == ord("d"))] = ord("e")  # of exponents
            if (texts == ord("_")).any():  # which Python allows in numbers
                return None
            values[part] = texts.view(f"S{len(columns)}")[:, 0].astype(np.float64)
    except ValueError:
        return None
    return values


def word_ranges(data: bytes, begin: int, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Byte ranges of the words between two offsets: their begins and their ends, (k,) int64 each."""
    letters = np.zeros(end - begin + 2, bool)
    letters[1:-1] = np.frombuffer(data, np.uint8, end - begin, begin) > ord(" ")
    edges = np.flatnonzero(letters[1:] != letters[:-1]) + begin
    return edges[::2], edges[1::2]


def fields_of_words(begin: np.ndarray, end: np.ndarray) -> TextFields:
    """Fields of the words of a text between blanks, of their ranges, (n, 3) int64 each."""
    return TextFields(begin, end, np.zeros(begin.shape, bool), np.zeros(begin.shape, np.int64))


def blanked(data: bytes, mark: bytes) -> bytes:
    """Replace comments, from a mark to the end of the line, by as many blanks."""
    if mark not in data:
        return data
    lines = (line.partition(mark) for line in data.split(b"\n"))
    return b"\n".join(text + b" " * (len(sign) + len(comment)) for text, sign, comment in lines)
