"""NetCDF's classic formats, in which ExodusII files are kept: 32 and 64-bit offsets, and 64-bit data.

Unidata, *The NetCDF classic format specification*. All numbers are big-endian, all parts padded to 4 bytes. netCDF4 is
not used: it reads what a file that is cut short lacks as zeros, and needs a process of its own for damaged files.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor

#: Types of values by their numbers; 2 is text.
TYPES = {
    1: np.dtype("i1"), 2: np.dtype("S1"), 3: np.dtype(">i2"), 4: np.dtype(">i4"), 5: np.dtype(">f4"),
    6: np.dtype(">f8"), 7: np.dtype("u1"), 8: np.dtype(">u2"), 9: np.dtype(">u4"), 10: np.dtype(">i8"),
    11: np.dtype(">u8"),
}  # fmt: skip
#: Of the lists of a head.
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12

#: How much of a file is looked through for its head, bytes.
_HEAD = 64 << 20


def recognised(head: bytes) -> bool:
    """Whether a file begins as NetCDF's classic formats do."""
    return head[:3] == b"CDF" and head[3:4] in (b"\x01", b"\x02", b"\x05")


@dataclass(frozen=True)
class Variable:
    """Where a variable lies and what it is.

    Parameters
    ----------
    shape : tuple of int
        Without the number of records.
    dtype : numpy dtype
    begin : int
        Byte of its first value.
    of_records : bool
        Whether it has a value, of that shape, for each record.
    size : int
        Bytes of a record, or of all, padded.
    attributes : mapping of name to str or array
    """

    shape: tuple[int, ...]
    dtype: np.dtype
    begin: int
    of_records: bool
    size: int
    attributes: dict[str, object] = field(default_factory=dict)


class Classic:
    """A NetCDF file of a classic format, opened for reading.

    Every count is checked against the file's size before anything is read.

    Parameters
    ----------
    path : Path

    Raises
    ------
    FileError
        Where the head does not say what a head has to, or the file ends before a variable does.
    """

    def __init__(self, path: Path):
        self.path = path
        self._length = os.path.getsize(path)
        with open(path, "rb") as file:
            head = _Head(ByteCursor(path, file.read(_HEAD), is_text=False))
        records = head.count()
        dimensions = head.dimensions()
        self.attributes = head.attributes()
        self._variables = head.variables(dimensions)
        self._stride = _stride(list(self._variables.values()))
        if records == 2 ** (8 * head.width) - 1:  # of a file that was still being written
            first = min((one.begin for one in self._variables.values() if one.of_records), default=self._length)
            records = max(0, self._length - first) // max(1, self._stride)
        self.dimensions = {name: length or records for name, length in dimensions}
        for name, one in self._variables.items():
            last = (records - 1) * self._stride if one.of_records else 0
            size = int(np.prod(one.shape, dtype=object)) * one.dtype.itemsize
            if size and (records or not one.of_records) and one.begin + last + size > self._length:
                raise FileError(
                    path,
                    f"variable {name!r} ends at byte {one.begin + last + size}: the file ends at byte {self._length}",
                    "Write the file again with the program that made it: it is damaged or cut short.",
                )

    def __contains__(self, name: str) -> bool:
        return name in self._variables

    def __len__(self) -> int:
        return len(self._variables)

    def array(self, name: str, record: int = 0) -> np.ndarray:
        """The values of a variable, of one record where there are several; in the machine's byte order."""
        one = self._variables[name]
        with open(self.path, "rb") as file:
            file.seek(one.begin + (record * self._stride if one.of_records else 0))
            values = np.fromfile(file, one.dtype, int(np.prod(one.shape, dtype=object)))
        return values.astype(one.dtype.newbyteorder("=")).reshape(one.shape)

    def attribute(self, variable: str, name: str) -> object:
        """A text or an array that a variable has under a name, or None."""
        return self._variables[variable].attributes.get(name)


class _Head:
    """The head of a file, taken part by part."""

    def __init__(self, source: ByteCursor):
        self.source = source
        version = source.read_bytes(4, "the head")[3]
        self.width = 8 if version == 5 else 4  # bytes of a count
        self.offset = 4 if version == 1 else 8  # and of a place

    def count(self, width: int = 0) -> int:
        """The next number."""
        return int.from_bytes(self.source.read_bytes(width or self.width, "the head"), "big")

    def length(self, kind: int, each: int) -> int:
        """How many entries a list has, each of some bytes at least."""
        here = self.source.location
        tag, count = self.count(4), self.count()
        if tag not in (0, kind) or (tag == 0 and count) or count * each > len(self.source.data):
            raise self.source.error(f"the head's list at {here} has the kind {tag} and {count} entries")
        return count

    def padded(self, size: int) -> bytes:
        """Bytes, and what fills them up to four."""
        data = self.source.read_bytes(size, "the head")
        self.source.read_bytes(-size % 4, "the head")
        return data

    def name(self) -> str:
        return self.padded(self.count()).decode("utf-8", errors="replace")

    def type(self) -> np.dtype:
        here, number = self.source.location, self.count(4)
        if number not in TYPES:
            raise self.source.error(f"values at {here} are of type {number}: expected 1 to 11")
        return TYPES[number]

    def dimensions(self) -> list[tuple[str, int]]:
        return [(self.name(), self.count()) for _ in range(self.length(DIMENSIONS, 8))]

    def attributes(self) -> dict[str, object]:
        answer = {}
        for _ in range(self.length(ATTRIBUTES, 12)):
            name, dtype, count = self.name(), self.type(), self.count()
            data = self.padded(count * dtype.itemsize)
            text = dtype.kind == "S"
            answer[name] = data.decode("utf-8", errors="replace").rstrip("\0 ") if text else np.frombuffer(data, dtype)
        return answer

    def variables(self, dimensions: list[tuple[str, int]]) -> dict[str, Variable]:
        answer = {}
        for _ in range(self.length(VARIABLES, 20)):
            name = self.name()
            numbers = [self.count() for _ in range(self.length_of_shape())]
            if any(number >= len(dimensions) for number in numbers):
                raise self.source.error(f"variable {name!r} has the dimensions {numbers} of {len(dimensions)}")
            attributes, dtype, _ = self.attributes(), self.type(), self.count()
            shape = [dimensions[number][1] for number in numbers]
            of_records = bool(shape) and shape[0] == 0 and dimensions[numbers[0]][1] == 0
            shape = tuple(shape[1:] if of_records else shape)
            size = int(np.prod(shape, dtype=object)) * dtype.itemsize
            answer[name] = Variable(shape, dtype, self.count(self.offset), of_records, size + -size % 4, attributes)
        return answer

    def length_of_shape(self) -> int:
        count = self.count()
        if count * self.width > len(self.source.data):
            raise self.source.error(f"a variable has {count} dimensions before {self.source.location}")
        return count


def _stride(variables: list[Variable]) -> int:
    """Bytes from one record to the next."""
    parts = [one for one in variables if one.of_records]
    if len(parts) == 1:  # which alone is not padded
        return int(np.prod(parts[0].shape, dtype=object)) * parts[0].dtype.itemsize
    return sum(one.size for one in parts)
