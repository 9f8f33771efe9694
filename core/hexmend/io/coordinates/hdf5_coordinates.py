"""Coordinates in datasets of an HDF5 file, and their replacement."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.base.hdf5_output import writable_file
from hexmend.io.coordinates.binary_coordinates import BinaryCoordinates, BinaryPiece, check_columns, precision_notes


def describe_dataset(dataset: object, column: int, width: int) -> dict[str, object]:
    """Describe a dataset that holds one to three columns of coordinates, one after the other.

    Parameters
    ----------
    dataset : h5py.Dataset
    column, width : int
        The first column, and the number of columns.

    Returns
    -------
    dict
        For `locate_datasets`; of values that a subprocess can send.
    """
    offset = dataset.id.get_offset()  # None unless the values lie in one piece
    values = {"name": dataset.name, "type": dataset.dtype.str, "offset": -1 if offset is None else int(offset)}
    return {**values, "column": column, "width": width}


def locate_datasets(
    path: Path, points: np.ndarray, datasets: list[dict[str, object]], notes: tuple[str, ...] = ()
) -> BinaryCoordinates | HDF5Coordinates:
    """Return the coordinates of a file: as places in it where its datasets lie in one piece each.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    datasets : list of dict
        From `describe_dataset`.
    notes : tuple of str
    """
    if any(one["offset"] < 0 for one in datasets):
        return HDF5Coordinates(path, points, datasets, notes)
    pieces = []
    for one in datasets:
        dtype = np.dtype(one["type"])
        strides = (dtype.itemsize, dtype.itemsize * len(points))
        columns = slice(one["column"], one["column"] + one["width"])
        pieces.append(BinaryPiece(one["offset"], dtype, strides, slice(0, len(points)), columns))
    return BinaryCoordinates(path, points, tuple(pieces), notes)


@dataclass(frozen=True, eq=False)
class HDF5Coordinates:
    """Coordinates in chunks or compressed, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    The library writes them into a copy of the file: all other values stay, though not each byte.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    datasets : list of dict
        From `describe_dataset`.
    notes : tuple of str
    """

    path: Path
    points: np.ndarray
    datasets: list[dict[str, object]]
    notes: tuple[str, ...] = ()

    def write(self, file: Path, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        changed = ~(points == self.points)
        columns = [slice(one["column"], one["column"] + one["width"]) for one in self.datasets]
        check_columns(changed, columns)
        shutil.copyfile(self.path, file)
        with hdf5.library_errors(self.path), writable_file(file, "r+") as out:
            for one, part in zip(self.datasets, columns, strict=True):
                dataset = out[one["name"]]
                dataset[...] = points[:, part].T.reshape(dataset.shape)
        return self.notes + precision_notes(changed, [np.dtype(one["type"]) for one in self.datasets])
