"""Writer of NetCDF's classic format with 64-bit offsets (CDF-2), through SciPy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from hexmend.io.storage.file_progress import advance

#: Bytes of a string with the zero at its end, where none is longer (MAX_STR_LENGTH of ExodusII).
_STRING = 33
#: The unlimited dimension, which the library wants first.
_RECORDS = "time_step"


class ClassicWriter:
    """Builder of a NetCDF file, which is written at once when all variables have been added.

    The unlimited dimension is "time_step", with one record or none.

    Parameters
    ----------
    attributes : mapping of name to str or array
        Global attributes.
    """

    def __init__(self, attributes: dict[str, object]):
        self.dimensions: dict[str, int] = {_RECORDS: 0}
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
            Whole numbers of up to 32 bits, real numbers, or bytes.
        **attributes : object

        Raises
        ------
        ValueError
            For another length of a dimension than before.
        """
        for dimension, length in dimensions.items():
            if self.dimensions.setdefault(dimension, length) != length:
                raise ValueError(f"dimension {dimension} is {self.dimensions[dimension]} and {length} long")
        array = np.asarray(values)
        array = array if array.dtype.kind == "S" else array.astype(">i4" if array.dtype.kind in "bui" else ">f8")
        if _RECORDS in dimensions and len(dimensions) > 1:
            array = array[None]
        self._variables.append((name, tuple(dimensions), array, attributes))

    def add_strings(self, name: str, dimension: str, words: list[str]) -> None:
        """Add a variable of strings along a dimension, of 32 bytes each, or more where one is longer."""
        width = max(_STRING, *(len(word.encode()) + 1 for word in words))
        length = "len_name" if width == _STRING else f"len_{name}"
        self.add_variable(name, {dimension: len(words), length: width}, characters(words, width))

    def write(self, path: Path) -> None:
        """Write the file."""
        total = sum(values.nbytes for _, _, values, _ in self._variables)
        with netcdf_file(path, "w", version=2) as file:
            _set_attributes(file, self._attributes)
            for name, length in self.dimensions.items():
                file.createDimension(name, length or None)
            for name, dimensions, values, attributes in self._variables:
                variable = file.createVariable(name, values.dtype, dimensions)
                _set_attributes(variable, attributes)
                if values.size:
                    variable[:] = values
                    advance(values.nbytes, total)


def _set_attributes(owner: object, attributes: dict[str, object]) -> None:
    for name, value in attributes.items():
        setattr(owner, name, value.encode() if isinstance(value, str) else value)


def characters(words: list[str], width: int) -> np.ndarray:
    """Strings as rows of bytes, (k, width); longer ones are cut."""
    rows = [word.encode()[: width - 1].decode(errors="ignore").encode().ljust(width, b"\0") for word in words]
    return np.frombuffer(b"".join(rows), "S1").reshape(-1, width)
