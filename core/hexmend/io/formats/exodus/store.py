"""Container of ExodusII's variables: a NetCDF file of a classic format, or of NetCDF-4 on HDF5.

netCDF4 is not used: it reads what a file that is cut short lacks as zeros, and follows links out of an HDF5 file.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.formats.exodus.netcdf3 import ClassicReader, is_classic


@contextmanager
def open_store(path: Path) -> Iterator[ExodusStore]:
    """Open a file for reading, by the kind of its container."""
    if is_classic(path):
        yield ClassicReader(path)
        return
    with hdf5.open_file(path) as file:
        yield HDF5Store(path, file)


class HDF5Store:
    """NetCDF-4 file, whose dimensions and variables are HDF5 datasets; methods as of `ClassicReader`.

    Parameters
    ----------
    path : Path
    file : h5py.File
    """

    def __init__(self, path: Path, file: object):
        self.path = path
        with hdf5.library_errors(path):
            self._datasets = {name: file[name] for name in file if hasattr(file.get(name), "shape")}
            scales = {name for name, data in self._datasets.items() if data.attrs.get("CLASS") == b"DIMENSION_SCALE"}
            self.dimensions = {name: self._datasets[name].shape[0] for name in scales if self._datasets[name].shape}
            if "time_whole" in self._datasets:  # the scale of the unlimited dimension may be shorter than its variables
                self.dimensions["time_step"] = self._datasets["time_whole"].size

    def __contains__(self, name: str) -> bool:
        return name in self._datasets

    def __len__(self) -> int:
        return len(self._datasets)

    def array(self, name: str, record: int = 0) -> np.ndarray:
        dataset = self._datasets[name]
        if name.startswith("vals_"):
            dataset = _StepView(dataset, record)
        return hdf5.read_dataset(self.path, dataset)

    def dataset(self, name: str) -> object:
        """Dataset of a variable, h5py.Dataset."""
        return self._datasets[name]

    def attribute(self, variable: str, name: str) -> object:
        with hdf5.library_errors(self.path):
            value = self._datasets[variable].attrs.get(name)
        value = np.ravel(value)[0] if np.size(value) == 1 else value
        return value.decode(errors="replace") if isinstance(value, bytes) else value


class _StepView:
    """One time step of a dataset, with the interface that `hdf5.read_dataset` reads."""

    def __init__(self, dataset: object, record: int):
        self.name, self.dtype = dataset.name, dataset.dtype
        self.size = int(np.prod(dataset.shape[1:], dtype=object))
        self._dataset, self._record = dataset, record

    def __getitem__(self, key: object) -> np.ndarray:
        return self._dataset[self._record]


#: NetCDF file of either kind: dimensions and variables by name.
ExodusStore = ClassicReader | HDF5Store
