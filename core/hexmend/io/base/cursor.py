"""Cursor over a file's bytes, and checks of the words and numbers in a text file."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import count_words, exceeds_dtype, parse_numbers
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.storage.binary_rows import FileBytes, gather_integers, read_blocks, read_rows
from hexmend.io.storage.file_progress import report

_NUMERIC = re.compile(rb"[\s0-9.eE+\-]*")
_NOT_FINITE = re.compile(rb"(?:nan|inf(?:inity)?)(?=\s|$)", re.IGNORECASE)
_WORD = re.compile(rb"\S{1,4096}")
_SPACE = re.compile(rb"\s*")
_KEYWORD = re.compile(rb"[A-Za-z_]{2,}\Z")

_NEWLINE = b"\n"
#: Longest line in bytes: a file without line ends is not taken for a single line.
_LONGEST_LINE = 1 << 16
#: Bytes of numbers that are parsed at a time.
_TEXT = 1 << 24
#: Share of the work on a text that parsing it is.
_SHARE = 0.9
#: Bytes in which words and white space are looked for.
_NEAR = 1 << 13


class ByteCursor:
    """Cursor over a file's bytes; errors report line or offset.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes or FileBytes
        Content of the file.
    is_text : bool
        Numbers are decimals, and errors report the line; else errors report the offset in bytes.

    Attributes
    ----------
    pos : int
        Offset of the next byte to read.
    """

    def __init__(self, path: Path, data: bytes | FileBytes, is_text: bool = True):
        self.path, self.data, self.is_text = path, data, is_text
        self.pos = len(BOM_UTF8) if is_text and data[: len(BOM_UTF8)] == BOM_UTF8 else 0

    def error(self, problem: str, remedy: str = DAMAGED) -> FileError:
        """Make the error to raise; `problem` and `remedy` are as of `FileError`."""
        return FileError(self.path, problem, remedy)

    def location_of(self, pos: int) -> str:
        """Describe the location of a byte, such as "line 12"."""
        return f"line {self.data.count(_NEWLINE, 0, pos) + 1}" if self.is_text else f"byte {pos}"

    @property
    def location(self) -> str:
        """Location of the next byte, such as "line 12"."""
        return self.location_of(self.pos)

    @property
    def _end(self) -> str:
        return f"the file ends at {self.location_of(len(self.data))}"

    @property
    def at_end(self) -> bool:
        """True if only white space is left."""
        return self._after_space() == len(self.data)

    def rest_of_line(self) -> str:
        """Read the rest of the line, without white space at its ends; empty for a blank line."""
        end = self.data.find(b"\n", self.pos)
        end = len(self.data) if end < 0 else end
        line, self.pos = self.data[self.pos : min(end, self.pos + _LONGEST_LINE)], min(end + 1, len(self.data))
        return line.decode("utf-8", errors="replace").strip()

    def next_line(self) -> str:
        """Read the next line that is not blank; empty at the end of the file."""
        self.pos = self._after_space()
        return self.rest_of_line()

    def next_word(self) -> str:
        """Read the next word; empty at the end of the file."""
        begin = self._after_space()
        found = _WORD.match(self.data[begin : begin + _NEAR])
        self.pos = begin + found.end() if found else len(self.data)
        return found.group().decode("utf-8", errors="replace") if found else ""

    def _after_space(self) -> int:
        """Return the offset of the next byte that is not white space, or the length of the file."""
        pos = self.pos
        while near := self.data[pos : pos + _NEAR]:
            skipped = _SPACE.match(near).end()
            pos += skipped
            if skipped < len(near):
                break
        return pos

    def parse_count(self, word: str, label: str) -> int:
        """Convert a word that has been read to a count.

        Parameters
        ----------
        word : str
        label : str
            Meaning of the number, for errors.

        Raises
        ------
        FileError
            Where the word is not a natural number.
        """
        if not is_number(word):
            raise self.error(f"{label} is {quoted(word)} before {self.location}: expected a natural number")
        return int(word)

    def read_numbers(self, section: str, rows: int, width: int, dtype: np.dtype | type) -> np.ndarray:
        """Read rows * width decimal numbers.

        Parameters
        ----------
        section : str
            Name of the array, for errors.
        rows, width : int
        dtype : float64, int64 or uint64

        Returns
        -------
        (rows, width) array

        Raises
        ------
        FileError
            For missing numbers, words that are not numbers, and integers of more than 64 bits.
        """
        count = rows * width
        if count == 0:
            return np.empty((rows, width), dtype)
        values = self._plain_numbers(count, dtype)
        if values is None:
            self.data = self.data[:]  # the rest is for errors, and for files of unusual layout
            end = self._checked_end(section, rows, width, dtype)
            text = self.data[self.pos : end]
            values = parse_numbers(text, dtype)
            if np.dtype(dtype).kind in "iu" and exceeds_dtype(values, text):
                raise self.error(
                    f"{section} holds a whole number of more than 64 bits before {self.location_of(end + 1)}"
                )
            self.pos = end
        return values.reshape(rows, width)

    def _plain_numbers(self, count: int, dtype: np.dtype | type) -> np.ndarray | None:
        """Read numbers, (count,), block by block; None, and nothing is read, where anything else is between them."""
        if count > (len(self.data) - self.pos) // 2 + 1:
            return None
        values, at, k = np.empty(count, dtype), self.pos, 0
        while k < count:
            text = self.data[at : at + _TEXT]
            text = text[: _numeric_end(text, 0, at + len(text) == len(self.data))]
            numbers, found = parse_numbers(text, dtype), count_words(text)
            if not text or numbers is None or numbers.size != found:
                return None
            if values.dtype.kind in "iu" and exceeds_dtype(numbers, text):
                return None
            surplus = found - (count - k)
            if surplus > 0:  # the name of the next array begins with digits
                text, numbers = text.rsplit(None, surplus)[0], numbers[: count - k]
            values[k : k + len(numbers)] = numbers
            at, k = at + len(text), k + len(numbers)
            report(_SHARE * at, len(self.data))
        self.pos = at
        return values

    def read_numbers_until(self, section: str, mark: bytes, dtype: np.dtype | type) -> np.ndarray:
        """Read all decimal numbers before a word, and the word.

        Parameters
        ----------
        section : str
            Name of the array, for errors.
        mark : bytes
            The word.
        dtype : float64 or int64

        Returns
        -------
        (k,) array
        """
        end = self.data.find(mark, self.pos)
        if end < 0:
            raise self.error(f"{section} ends without {mark.decode()}: {self._end}")
        values = self.read_numbers_to(section, end, dtype)
        self.pos = end + len(mark)
        return values

    def read_numbers_to(self, section: str, end: int, dtype: np.dtype | type) -> np.ndarray:
        """Read all decimal numbers before the offset `end`, (k,) array; see `read_numbers_until`."""
        return self.read_numbers(section, count_words(self.data, self.pos, end), 1, dtype)[:, 0]

    def read_binary(self, section: str, rows: int, width: int, dtype: np.dtype | str) -> np.ndarray:
        """Read rows * width binary numbers, (rows, width), in the byte order of the file; a view of data in memory."""
        begin, dtype = self._skip_rows(section, rows, width, dtype)
        return read_rows(self.data, begin, rows, width, dtype)

    def binary_blocks(
        self, section: str, rows: int, width: int, dtype: np.dtype | str
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """Read rows * width binary numbers block by block; see `hexmend.io.storage.binary_rows.read_blocks`."""
        begin, dtype = self._skip_rows(section, rows, width, dtype)
        return read_blocks(self.data, begin, rows, width, dtype)

    def read_integers(self, section: str, rows: int, width: int, dtype: np.dtype | str) -> np.ndarray:
        """Read rows * width binary whole numbers, (rows, width) int32, or int64 where one needs it."""
        return gather_integers((rows, width), self.binary_blocks(section, rows, width, dtype))

    def _skip_rows(self, section: str, rows: int, width: int, dtype: np.dtype | str) -> tuple[int, np.dtype]:
        """Go behind binary numbers, which must be there; returns the offset of the first, and the type."""
        dtype, begin = np.dtype(dtype), self.pos
        size, left = rows * width * dtype.itemsize, len(self.data) - begin
        if size > left:
            have = left // max(1, width * dtype.itemsize)
            raise self.error(f"{section} ends after {have} of {rows} rows: the file ends at byte {len(self.data)}")
        self.pos += size
        return begin, dtype

    def read_bytes(self, size: int, label: str) -> bytes:
        """Read `size` bytes; `label` names them in errors."""
        if size > len(self.data) - self.pos:
            raise self.error(f"{label} needs {size} bytes at byte {self.pos}: the file ends at byte {len(self.data)}")
        self.pos += size
        return self.data[self.pos - size : self.pos]

    def _checked_end(self, section: str, rows: int, width: int, dtype: np.dtype | type) -> int:
        """Parse number by number; returns the offset behind the last one, and raises at the first other word."""
        kind = float if np.dtype(dtype).kind == "f" else int
        end, k = self.pos, 0
        for found in _WORD.finditer(self.data, end):
            if k == rows * width:
                return end
            word = found.group()
            try:
                if b"_" in word or (np.dtype(dtype).kind == "u" and word[:1] == b"-"):  # accepted by Python
                    raise ValueError
                kind(word)
            except ValueError:
                location, shown = self.location_of(found.start()), quoted(word.decode("utf-8", errors="replace"))
                problem = f"{section} ends after {k // width} of {rows} rows: {location} continues with {shown}"
                if not _KEYWORD.match(word):
                    problem = f"{section} holds {shown} in row {k // width + 1} of {rows} ({location})"
                    problem += ": expected a number" if kind is float else ": expected a whole number"
                raise self.error(problem) from None
            k, end = k + 1, found.end()
        if k == rows * width:
            return end
        raise self.error(f"{section} ends after {k // width} of {rows} rows: {self._end}")


def _numeric_end(data: bytes, begin: int, is_all: bool = True) -> int:
    """Offset at which numbers end: before the next word with a letter, or which the data do not hold to its end."""
    end = _NUMERIC.match(data, begin).end()
    while special := _NOT_FINITE.match(data, end):
        end = _NUMERIC.match(data, special.end()).end()
    if end < len(data) or not is_all:
        while end > begin and not data[end - 1 : end].isspace():
            end -= 1  # a word such as 2nd begins like a number
    return end


def read_text_bytes(path: Path) -> bytes:
    """Read a text file as bytes, without a byte-order mark.

    Raises
    ------
    FileError
        If its first 4,096 bytes hold a zero.
    """
    with open(path, "rb") as file:
        if b"\0" in file.read(4096):
            raise FileError(path, "holds bytes that are not text", "Check its suffix, or write the file again.")
        file.seek(0)
        return file.read().removeprefix(BOM_UTF8)


def is_number(word: str) -> bool:
    """Return True if a word is a natural number of at most 18 digits."""
    return word.isascii() and word.isdigit() and len(word) < 19


def quoted(word: str) -> str:
    """Quote a word of the file for a message, printable and of 20 characters at most."""
    word = "".join(c if c.isprintable() else "?" for c in word[:25])
    return repr(word[:20] + "..." if len(word) > 20 else word) if word else "missing"
