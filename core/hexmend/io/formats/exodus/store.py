"""Container of ExodusII's variables: a NetCDF file of a classic format, or of NetCDF-4 on HDF5.

netCDF4 is not used: it reads what a file that is cut short lacks as zeros, and follows links out of an HDF5 file.

Variables of an ExodusII file, checked for type and shape.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.numbering import check_numbers
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.exodus.netcdf3 import ClassicReader, is_classic
from hexmend.io.storage.binary_rows import gather_integers, row_blocks


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
        return hdf5.read_dataset(self.path, self._datasets[name], record if name.startswith("vals_") else None)

    def dataset(self, name: str) -> object:
        """Dataset of a variable, h5py.Dataset."""
        return self._datasets[name]

    def attribute(self, variable: str, name: str) -> object:
        value = self._datasets[variable].attrs.get(name)
        value = np.ravel(value)[0] if np.size(value) == 1 else value
        return value.decode(errors="replace") if isinstance(value, bytes) else value


#: NetCDF file of either kind: dimensions and variables by name.
ExodusStore = ClassicReader | HDF5Store


class CheckedVariables:
    """Variables of one file; the methods raise `FileError` for another type or shape than asked for.

    Parameters
    ----------
    path : Path
    store : ExodusStore
    step : int
        Time step that is read, from 0.
    """

    def __init__(self, path: Path, store: ExodusStore, step: int):
        self.path, self.store, self.step = path, store, step

    def array(self, name: str, *shape: int) -> np.ndarray:
        """Numbers, of exactly this shape, of any numeric type."""
        values = self.store.array(name, self.step)
        if values.dtype.kind not in "iuf" or values.shape != shape:
            problem = f"variable {name!r} holds {values.dtype} {values.shape}: expected numbers {shape}"
            raise FileError(self.path, problem, DAMAGED)
        return values

    def integers(self, name: str, *shape: int) -> np.ndarray:
        """Whole numbers, of exactly this shape, int64."""
        values = self.array(name, *shape)
        if values.dtype.kind == "f":
            raise FileError(self.path, f"variable {name!r} holds {values.dtype}: expected whole numbers", DAMAGED)
        return values.astype(np.int64)

    def nodes(self, name: str, *shape: int) -> np.ndarray:
        """Numbers of nodes, from 0, of exactly this shape, int32 where they fit, else int64."""
        values = self.array(name, *shape)
        if values.dtype == np.int32:
            values -= 1  # the array is nobody else's
            return values
        if values.dtype.kind == "f":
            return self.integers(name, *shape) - 1  # an error
        blocks = row_blocks(len(values), values[:1].nbytes)
        return gather_integers(shape, ((part, values[part].astype(np.int64) - 1) for part in blocks))

    def members(self, name: str, dimension: str, count: int, label: str) -> np.ndarray:
        """Members of a set, from 0, int64; `dimension` names their number, `count` is that of all `label`."""
        members = self.integers(name, self.store.dimensions.get(dimension, 0)) - 1
        check_numbers(self.path, f"{name!r} refers to the {label}", members, count)
        return members

    def ids(self, name: str, dimension: str) -> list[int]:
        """Ids of the blocks or sets that a dimension counts; 1, 2, ... where the file has none."""
        count = self.store.dimensions.get(dimension, 0)
        if count > len(self.store):  # each has one variable at least
            raise FileError(self.path, f"{dimension} is {count}, of {len(self.store)} variables", DAMAGED)
        return self.integers(name, count).tolist() if name in self.store else list(range(1, count + 1))

    def strings(self, name: str) -> list[str]:
        """Strings; none where there is no such variable, or where it holds anything else."""
        if name not in self.store:
            return []
        values = self.store.array(name, self.step)
        if values.dtype.kind != "S" or values.ndim != 2:
            return []
        rows = [bytes(row.tobytes()).split(b"\0")[0] for row in values]
        return [row.decode("utf-8", errors="replace").strip() for row in rows]
