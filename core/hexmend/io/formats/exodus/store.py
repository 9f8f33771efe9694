"""Container of ExodusII's variables: a NetCDF file of a classic format, or one on HDF5.

netCDF4 is not used: it reads what a file that is cut short lacks as zeros, and follows links out of an HDF5 file.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.formats.exodus.netcdf3 import Classic


class ExodusStore(Protocol):
    """Dimensions and variables by name."""

    dimensions: dict[str, int]

    def __contains__(self, name: str) -> bool:
        """Whether there is a variable of that name."""

    def __len__(self) -> int:
        """Number of variables."""

    def array(self, name: str, record: int = 0) -> np.ndarray:
        """The values of a variable; of one that has a value for each time step, those of one step."""

    def attribute(self, variable: str, name: str) -> object:
        """What a variable has under a name, or None."""


@contextmanager
def opened(path: Path) -> Iterator[ExodusStore]:
    """The store that a file is."""
    with open(path, "rb") as file:
        classic = file.read(3) == b"CDF"
    if classic:
        yield Classic(path)
        return
    with hdf5.open_file(path) as file:
        yield OnHdf5(path, file)


class OnHdf5:
    """A NetCDF-4 file, whose dimensions and variables are HDF5's datasets.

    Parameters
    ----------
    path : Path
    file : h5py.File
    """

    def __init__(self, path: Path, file: object):
        self.path = path
        try:
            self._sets = {name: file[name] for name in file if hasattr(file.get(name), "shape")}
            scales = {name for name, one in self._sets.items() if one.attrs.get("CLASS") == b"DIMENSION_SCALE"}
            self.dimensions = {name: self._sets[name].shape[0] for name in scales if self._sets[name].shape}
            if "time_whole" in self._sets:  # a dimension that grows is not told how long it has become
                self.dimensions["time_step"] = self._sets["time_whole"].size
        except (OSError, RuntimeError, ValueError, KeyError, TypeError) as error:
            raise hdf5.damaged_file(path, error) from None

    def __contains__(self, name: str) -> bool:
        return name in self._sets

    def __len__(self) -> int:
        return len(self._sets)

    def array(self, name: str, record: int = 0) -> np.ndarray:
        one = self._sets[name]
        if name.startswith("vals_"):
            one = _Record(one, record)
        return hdf5.read_dataset(self.path, one)

    def attribute(self, variable: str, name: str) -> object:
        try:
            value = self._sets[variable].attrs.get(name)
        except (OSError, RuntimeError, ValueError, KeyError, TypeError) as error:
            raise hdf5.damaged_file(self.path, error) from None
        value = np.ravel(value)[0] if np.size(value) == 1 else value
        return value.decode(errors="replace") if isinstance(value, bytes) else value


class _Record:
    """One step of a dataset, to be read as a dataset is."""

    def __init__(self, dataset: object, record: int):
        self.name, self.dtype = dataset.name, dataset.dtype
        self.size = int(np.prod(dataset.shape[1:], dtype=object))
        self._dataset, self._record = dataset, record

    def __getitem__(self, key: object) -> np.ndarray:
        return self._dataset[self._record]
