"""Reader of NetCDF's classic formats: 32-bit offsets, 64-bit offsets and 64-bit data (CDF-1, CDF-2, CDF-5).

Unidata, *The NetCDF classic format specification*. All numbers are big-endian, all parts padded to 4 bytes. netCDF4 is
not used: it reads what a file that is cut short lacks as zeros, and needs a process of its own for damaged files.
`scipy.io.netcdf_file` is not used: it has no 64-bit data, so no ids of 64 bits and no arrays of 2 GB, and gives no
offsets, by which coordinates are replaced in a copy; and attributes of a file replace those of its own objects.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.storage.binary_rows import FileBytes, native, read_rows

#: Types of values (nc_type); 2 is text.
TYPES = {
    1: np.dtype("i1"), 2: np.dtype("S1"), 3: np.dtype(">i2"), 4: np.dtype(">i4"), 5: np.dtype(">f4"),
    6: np.dtype(">f8"), 7: np.dtype("u1"), 8: np.dtype(">u2"), 9: np.dtype(">u4"), 10: np.dtype(">i8"),
    11: np.dtype(">u8"),
}  # fmt: skip
#: Tags of the lists in the header.
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12

#: Most bytes of a header.
_HEADER_SIZE = 64 << 20


def recognised(head: bytes) -> bool:
    """Return True if a file begins like NetCDF's classic formats."""
    return head[:3] == b"CDF" and head[3:4] in (b"\x01", b"\x02", b"\x05")


def is_classic(path: Path) -> bool:
    """Return True for a file of a classic format, False for one on HDF5."""
    with open(path, "rb") as file:
        return file.read(3) == b"CDF"


@dataclass(frozen=True)
class Variable:
    """Variable of the header.

    Parameters
    ----------
    shape : tuple of int
        Of one record, or of all values.
    dtype : numpy dtype
    begin : int
        Offset of its first value, bytes.
    is_record : bool
        True if it has values of that shape for each record of the unlimited dimension.
    size : int
        Bytes of one record, or of all values, padded to 4.
    attributes : mapping of name to str or array
    """

    shape: tuple[int, ...]
    dtype: np.dtype
    begin: int
    is_record: bool
    size: int
    attributes: dict[str, object] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of values of one record, or of all."""
        return int(np.prod(self.shape, dtype=object))

    @property
    def data_size(self) -> int:
        """Bytes of one record, or of all values, without padding."""
        return self.count * self.dtype.itemsize


class ClassicReader:
    """NetCDF file of a classic format.

    Every count is checked against the file's size before anything is read.

    Parameters
    ----------
    path : Path

    Raises
    ------
    FileError
        For a malformed header, or a file that ends before a variable does.
    """

    def __init__(self, path: Path):
        self.path = path
        self._data = FileBytes(path)
        self._length = len(self._data)
        header = _Header(ByteCursor(path, self._data[:_HEADER_SIZE], is_text=False))
        records = header.count()
        dimensions = header.dimensions()
        self.attributes = header.attributes()
        self._variables = header.variables(dimensions)
        self._record_size = _record_size(list(self._variables.values()))
        if records == 2 ** (8 * header.width) - 1:  # a file that was still being written
            begins = (variable.begin for variable in self._variables.values() if variable.is_record)
            first = min(begins, default=self._length)
            records = max(0, self._length - first) // max(1, self._record_size)
        self.dimensions = {name: length or records for name, length in dimensions}
        for name, variable in self._variables.items():
            last = (records - 1) * self._record_size if variable.is_record else 0
            end = variable.begin + last + variable.data_size
            if variable.data_size and (records or not variable.is_record) and end > self._length:
                problem = f"variable {name!r} ends at byte {end}: the file ends at byte {self._length}"
                raise FileError(path, problem, DAMAGED)

    def __contains__(self, name: str) -> bool:
        return name in self._variables

    def __len__(self) -> int:
        return len(self._variables)

    def array(self, name: str, record: int = 0) -> np.ndarray:
        """Values of a variable, of one record where it has several, in the machine's byte order."""
        variable = self._variables[name]
        begin = variable.begin + (record * self._record_size if variable.is_record else 0)
        values = native(read_rows(self._data, begin, variable.count, 1, variable.dtype))
        return values.reshape(variable.shape)

    def variable(self, name: str) -> Variable:
        """Variable of the header."""
        return self._variables[name]

    def attribute(self, variable: str, name: str) -> object:
        """Attribute of a variable, a string or an array; None where it has none of that name."""
        return self._variables[variable].attributes.get(name)


class _Header:
    """Parser of a file's header; its methods take the next part."""

    def __init__(self, source: ByteCursor):
        self.source = source
        version = source.read_bytes(4, "the header")[3]
        self.width = 8 if version == 5 else 4  # bytes of a count
        self.offset = 4 if version == 1 else 8  # bytes of an offset

    def count(self, width: int = 0) -> int:
        """Take a number, of the width of a count unless given."""
        return int.from_bytes(self.source.read_bytes(width or self.width, "the header"), "big")

    def length(self, kind: int, each: int) -> int:
        """Take the number of entries of a list with the tag `kind`, of at least `each` bytes an entry."""
        here = self.source.location
        tag, count = self.count(4), self.count()
        if tag not in (0, kind) or (tag == 0 and count) or count * each > len(self.source.data):
            raise self.source.error(f"the header's list at {here} has the kind {tag} and {count} entries")
        return count

    def padded(self, size: int) -> bytes:
        """Take bytes and their padding to 4."""
        data = self.source.read_bytes(size, "the header")
        self.source.read_bytes(-size % 4, "the header")
        return data

    def name(self) -> str:
        """Take a name."""
        return self.padded(self.count()).decode("utf-8", errors="replace")

    def type(self) -> np.dtype:
        """Take the type of values."""
        here, number = self.source.location, self.count(4)
        if number not in TYPES:
            raise self.source.error(f"values at {here} are of type {number}: expected 1 to 11")
        return TYPES[number]

    def dimensions(self) -> list[tuple[str, int]]:
        """Take the names and lengths of all dimensions."""
        return [(self.name(), self.count()) for _ in range(self.length(DIMENSIONS, 8))]

    def attributes(self) -> dict[str, object]:
        """Take a list of attributes."""
        found = {}
        for _ in range(self.length(ATTRIBUTES, 12)):
            name, dtype, count = self.name(), self.type(), self.count()
            data = self.padded(count * dtype.itemsize)
            text = dtype.kind == "S"
            found[name] = data.decode("utf-8", errors="replace").rstrip("\0 ") if text else np.frombuffer(data, dtype)
        return found

    def variables(self, dimensions: list[tuple[str, int]]) -> dict[str, Variable]:
        """Take the list of variables."""
        found = {}
        for _ in range(self.length(VARIABLES, 20)):
            name = self.name()
            numbers = [self.count() for _ in range(self.rank())]
            if any(number >= len(dimensions) for number in numbers):
                raise self.source.error(f"variable {name!r} has the dimensions {numbers} of {len(dimensions)}")
            attributes, dtype, _ = self.attributes(), self.type(), self.count()
            shape = [dimensions[number][1] for number in numbers]
            is_record = bool(shape) and shape[0] == 0 and dimensions[numbers[0]][1] == 0
            shape = tuple(shape[1:] if is_record else shape)
            size = int(np.prod(shape, dtype=object)) * dtype.itemsize
            found[name] = Variable(shape, dtype, self.count(self.offset), is_record, size + -size % 4, attributes)
        return found

    def rank(self) -> int:
        """Take the number of dimensions of a variable."""
        count = self.count()
        if count * self.width > len(self.source.data):
            raise self.source.error(f"a variable has {count} dimensions before {self.source.location}")
        return count


def _record_size(variables: list[Variable]) -> int:
    """Bytes from one record to the next."""
    records = [variable for variable in variables if variable.is_record]
    if len(records) == 1:  # a single record variable is not padded
        return records[0].data_size
    return sum(variable.size for variable in records)
