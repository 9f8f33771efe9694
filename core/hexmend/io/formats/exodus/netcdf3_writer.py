"""Writer of NetCDF's classic formats with 64-bit offsets (CDF-2) and 64-bit data (CDF-5).

netCDF4 is not used: for this alone it would be 10 to 22 MB more to install, with an HDF5 library of its own.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from hexmend.io.formats.exodus.netcdf3 import ATTRIBUTES, DIMENSIONS, TYPES, VARIABLES
from hexmend.io.storage.file_progress import advance

#: nc_type of NumPy's types.
_NC_TYPES = {"S": 2, "i4": 4, "i8": 10, "f4": 5, "f8": 6}

#: Bytes of a string with the zero at its end, where none is longer (MAX_STR_LENGTH of ExodusII).
_STRING = 33


class ClassicWriter:
    """Builder of a NetCDF file, which is written at once when all variables have been added.

    The unlimited dimension is "time_step", with one record or none.

    Parameters
    ----------
    attributes : mapping of name to str or array
        Global attributes.
    """

    def __init__(self, attributes: dict[str, object]):
        self.dimensions: dict[str, int] = {}
        self._attributes = attributes
        self._variables: list[tuple[str, tuple[str, ...], np.ndarray, dict[str, object]]] = []

    def add_variable(self, name: str, dimensions: dict[str, int], values: object, /, **attributes: object) -> None:
        """Add a variable.

        Parameters
        ----------
        name : str
        dimensions : dict of str to int
            Names and lengths of its dimensions; 0 is the length of "time_step" alone.
        values : array_like
        **attributes : object

        Raises
        ------
        ValueError
            For another length of a dimension than before.
        """
        for dimension, length in dimensions.items():
            if self.dimensions.setdefault(dimension, length) != length:
                raise ValueError(f"dimension {dimension} is {self.dimensions[dimension]} and {length} long")
        self._variables.append((name, tuple(dimensions), np.asarray(values), attributes))

    def add_strings(self, name: str, dimension: str, words: list[str]) -> None:
        """Add a variable of strings along a dimension, of 32 bytes each, or more where one is longer."""
        width = max(_STRING, *(len(word.encode()) + 1 for word in words))
        length = "len_name" if width == _STRING else f"len_{name}"
        self.add_variable(name, {dimension: len(words), length: width}, characters(words, width))

    def write(self, path: Path) -> None:
        """Write the file, as CDF-2, or as CDF-5 where a number needs 64 bits or an array 2 GB."""
        values = [self._encoded(values) for _, _, values, _ in self._variables]
        wide = any(array.dtype == TYPES[10] or array.nbytes >= 1 << 31 for array in values)
        fixed = [k for k, (_, names, _, _) in enumerate(self._variables) if "time_step" not in names]
        order = fixed + [k for k in range(len(values)) if k not in set(fixed)]
        begins = [0] * len(values)
        place = len(self._header(values, begins, wide))
        for k in order:
            begins[k] = place
            place += values[k].nbytes + -values[k].nbytes % 4
        with open(path, "wb") as file:
            file.write(self._header(values, begins, wide))
            for k in order:
                file.write(values[k].tobytes())
                advance(values[k].nbytes, place)
                file.write(b"\0" * (-values[k].nbytes % 4))

    @staticmethod
    def _encoded(values: np.ndarray) -> np.ndarray:
        """Values in a type of the format, big-endian."""
        if values.dtype.kind == "S":
            return values
        if values.dtype.kind in "bui":
            small = values.size == 0 or (values.min() >= -(2**31) and values.max() < 2**31)
            return values.astype(">i4" if small else ">i8")
        return values.astype(">f8")

    def _header(self, values: list[np.ndarray], begins: list[int], wide: bool) -> bytes:
        """Header of the file; `begins` are the offsets of the values, `wide` says CDF-5."""
        count = struct.Struct(">q" if wide else ">i").pack
        names = list(self.dimensions)

        def text(word: str) -> bytes:
            data = word.encode()
            return count(len(data)) + data + b"\0" * (-len(data) % 4)

        def attributes(table: dict[str, object]) -> bytes:
            if not table:
                return bytes(4) + count(0)
            parts = [struct.pack(">i", ATTRIBUTES) + count(len(table))]
            for name, value in table.items():
                if isinstance(value, str):
                    parts.append(text(name) + struct.pack(">i", 2) + text(value))
                else:
                    value = np.atleast_1d(value)
                    nc_type = _NC_TYPES[value.dtype.str[1:]]
                    parts.append(text(name) + struct.pack(">i", nc_type) + count(value.size))
                    parts.append(value.astype(TYPES[nc_type]).tobytes())
            return b"".join(parts)

        steps = int(any("time_step" in shape and array.size for _, shape, array, _ in self._variables))
        parts = [b"CDF\x05" if wide else b"CDF\x02", count(steps), struct.pack(">i", DIMENSIONS), count(len(names))]
        parts += [text(name) + count(length) for name, length in self.dimensions.items()]
        parts += [attributes(self._attributes), struct.pack(">i", VARIABLES), count(len(values))]
        for (name, shape, _, table), value, begin in zip(self._variables, values, begins, strict=True):
            nc_type = next(number for number, dtype in TYPES.items() if dtype == value.dtype)
            size = value.nbytes + -value.nbytes % 4
            parts += [text(name), count(len(shape)), *(count(names.index(one)) for one in shape), attributes(table)]
            parts += [struct.pack(">i", nc_type), count(size), struct.pack(">q", begin)]
        return b"".join(parts)


def characters(words: list[str], width: int) -> np.ndarray:
    """Strings as rows of bytes, (k, width); longer ones are cut."""
    rows = [word.encode()[: width - 1].decode(errors="ignore").encode().ljust(width, b"\0") for word in words]
    return np.frombuffer(b"".join(rows), "S1").reshape(-1, width)
