"""Writing NetCDF's classic formats, as `hexmend.io.formats.exodus.netcdf3` reads them.

netCDF4 is not used: for this alone it would be 10 to 22 MB more to install, with an HDF5 library of its own.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from hexmend.io.formats.exodus.netcdf3 import ATTRIBUTES, DIMENSIONS, TYPES, VARIABLES

#: What numpy's types are written as.
_NUMBERS = {"S": 2, "i4": 4, "i8": 10, "f4": 5, "f8": 6}

#: Bytes of a text that is not longer, with the zero at its end.
_TEXT = 33


class ClassicWriter:
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
