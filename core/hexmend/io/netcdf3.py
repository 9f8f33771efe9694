"""NetCDF's classic formats, in which ExodusII files are kept: 32 and 64-bit offsets, and 64-bit data.

Unidata, *The NetCDF classic format specification*. All numbers are big-endian, all parts padded to 4 bytes.
"""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.source import Source

#: Types of values by their numbers; 2 is text.
TYPES = {
    1: np.dtype("i1"), 2: np.dtype("S1"), 3: np.dtype(">i2"), 4: np.dtype(">i4"), 5: np.dtype(">f4"),
    6: np.dtype(">f8"), 7: np.dtype("u1"), 8: np.dtype(">u2"), 9: np.dtype(">u4"), 10: np.dtype(">i8"),
    11: np.dtype(">u8"),
}  # fmt: skip
#: Of the lists of a head.
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12

#: What numpy's types are written as.
_NUMBERS = {"S": 2, "i4": 4, "i8": 10, "f4": 5, "f8": 6}

#: Bytes of a text that is not longer, with the zero at its end.
_TEXT = 33

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
            head = _Head(Source(path, file.read(_HEAD), text=False))
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

    def __init__(self, source: Source):
        self.source = source
        version = source.take(4, "the head")[3]
        self.width = 8 if version == 5 else 4  # bytes of a count
        self.offset = 4 if version == 1 else 8  # and of a place

    def count(self, width: int = 0) -> int:
        """The next number."""
        return int.from_bytes(self.source.take(width or self.width, "the head"), "big")

    def length(self, kind: int, each: int) -> int:
        """How many entries a list has, each of some bytes at least."""
        here = self.source.here
        tag, count = self.count(4), self.count()
        if tag not in (0, kind) or (tag == 0 and count) or count * each > len(self.source.data):
            raise self.source.error(f"the head's list at {here} has the kind {tag} and {count} entries")
        return count

    def padded(self, size: int) -> bytes:
        """Bytes, and what fills them up to four."""
        data = self.source.take(size, "the head")
        self.source.take(-size % 4, "the head")
        return data

    def name(self) -> str:
        return self.padded(self.count()).decode("utf-8", errors="replace")

    def type(self) -> np.dtype:
        here, number = self.source.here, self.count(4)
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
            raise self.source.error(f"a variable has {count} dimensions before {self.source.here}")
        return count


def _stride(variables: list[Variable]) -> int:
    """Bytes from one record to the next."""
    parts = [one for one in variables if one.of_records]
    if len(parts) == 1:  # which alone is not padded
        return int(np.prod(parts[0].shape, dtype=object)) * parts[0].dtype.itemsize
    return sum(one.size for one in parts)


class Writer:
    """A NetCDF file in the making: what is in it is told first, then it is written at once.

    The only records are those of the unlimited dimension "time_step"; there is one, or none.

    Parameters
    ----------
    attributes : mapping of name to str or array
        Of the file as a whole.
    """

    def __init__(self, attributes: dict[str, object]):
        self.dimensions: dict[str, int] = {}
        self._attributes = attributes
        self._variables: list[tuple[str, tuple[str, ...], np.ndarray, dict[str, object]]] = []

    def add(self, name: str, dimensions: dict[str, int], values: object, /, **attributes: object) -> None:
        """A variable whose dimensions have these names and lengths; 0 is the length of "time_step" alone."""
        for one, length in dimensions.items():
            if self.dimensions.setdefault(one, length) != length:
                raise ValueError(f"dimension {one} is {self.dimensions[one]} and {length} long")
        self._variables.append((name, tuple(dimensions), np.asarray(values), attributes))

    def add_text(self, name: str, dimension: str, words: list[str]) -> None:
        """A variable of texts, one for each entry of a dimension; texts are 32 bytes long, or as long as need be."""
        rows = [word.encode() for word in words]
        width = max(_TEXT, *(len(row) + 1 for row in rows))
        letters = np.frombuffer(b"".join(row.ljust(width, b"\0") for row in rows), "S1").reshape(-1, width)
        self.add(name, {dimension: len(rows), "len_name" if width == _TEXT else f"len_{name}": width}, letters)

    def write(self, path: Path) -> None:
        """Write the file: with 64-bit offsets, or 64-bit data where a number or an array is too large for these."""
        values = [self._written(values) for _, _, values, _ in self._variables]
        wide = any(one.dtype == TYPES[10] or one.nbytes >= 1 << 31 for one in values)
        fixed = [k for k, (_, names, _, _) in enumerate(self._variables) if "time_step" not in names]
        order = fixed + [k for k in range(len(values)) if k not in set(fixed)]
        begins = [0] * len(values)
        place = len(self._head(values, begins, wide))
        for k in order:
            begins[k] = place
            place += values[k].nbytes + -values[k].nbytes % 4
        with open(path, "wb") as file:
            file.write(self._head(values, begins, wide))
            for k in order:
                file.write(values[k].tobytes())
                file.write(b"\0" * (-values[k].nbytes % 4))

    @staticmethod
    def _written(values: np.ndarray) -> np.ndarray:
        if values.dtype.kind == "S":
            return values
        if values.dtype.kind in "bui":
            small = values.size == 0 or (values.min() >= -(2**31) and values.max() < 2**31)
            return values.astype(">i4" if small else ">i8")
        return values.astype(">f8")

    def _head(self, values: list[np.ndarray], begins: list[int], wide: bool) -> bytes:
        count = struct.Struct(">q" if wide else ">i").pack
        names = list(self.dimensions)

        def text(word: str) -> bytes:
            data = word.encode()
            return count(len(data)) + data + b"\0" * (-len(data) % 4)

        def attributes(those: dict[str, object]) -> bytes:
            if not those:
                return bytes(4) + count(0)
            parts = [struct.pack(">i", ATTRIBUTES) + count(len(those))]
            for name, value in those.items():
                if isinstance(value, str):
                    parts.append(text(name) + struct.pack(">i", 2) + text(value))
                else:
                    value = np.atleast_1d(value)
                    number = _NUMBERS[value.dtype.str[1:]]
                    parts.append(text(name) + struct.pack(">i", number) + count(value.size))
                    parts.append(value.astype(TYPES[number]).tobytes())
            return b"".join(parts)

        steps = int(any("time_step" in those and values.size for _, those, values, _ in self._variables))
        parts = [b"CDF\x05" if wide else b"CDF\x02", count(steps), struct.pack(">i", DIMENSIONS), count(len(names))]
        parts += [text(name) + count(length) for name, length in self.dimensions.items()]
        parts += [attributes(self._attributes), struct.pack(">i", VARIABLES), count(len(values))]
        for (name, those, _, more), value, begin in zip(self._variables, values, begins, strict=True):
            number = next(number for number, dtype in TYPES.items() if dtype == value.dtype)
            size = value.nbytes + -value.nbytes % 4
            parts += [text(name), count(len(those)), *(count(names.index(one)) for one in those), attributes(more)]
            parts += [struct.pack(">i", number), count(size), struct.pack(">q", begin)]
        return b"".join(parts)
