"""Coordinates as binary numbers in a file: the place of each, and their replacement.

Coordinates in datasets of an HDF5 file, and their replacement.
"""

from __future__ import annotations

import mmap
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.base.hdf5 import writable_file
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.storage.atomic import AtomicFiles

#: Note for coordinates of 32 bits.
SINGLE_PRECISION = "The file stores coordinates as 32-bit numbers: the new ones are rounded to 7 digits."


#: All three coordinates of a node.
ALL_COLUMNS = slice(0, 3)


@dataclass(frozen=True, eq=False)
class BinaryPiece:
    """Coordinates of consecutive nodes, which lie at equal distances in the file.

    Parameters
    ----------
    offset : int
        Byte of the first number.
    dtype : numpy dtype
        With the byte order of the file.
    strides : tuple of int
        Bytes from one node to the next, and from one coordinate to the next.
    rows : slice
        Nodes.
    columns : slice
        Coordinates.
    """

    offset: int
    dtype: np.dtype
    strides: tuple[int, int]
    rows: slice
    columns: slice

    @classmethod
    def of_columns(cls, offset: int, dtype: np.dtype, count: int, columns: slice) -> BinaryPiece:
        """Make a piece of coordinates that are stored column by column."""
        return cls(offset, dtype, (dtype.itemsize, dtype.itemsize * count), slice(0, count), columns)

    def view(self, data: object) -> np.ndarray:
        """View of the coordinates in the bytes of the file."""
        shape = (self.rows.stop - self.rows.start, self.columns.stop - self.columns.start)
        return np.ndarray(shape, self.dtype, data, self.offset, self.strides)


@dataclass(frozen=True, eq=False)
class BinaryCoordinates:
    """Coordinates of a binary file, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
        As the reader of the format gives them.
    pieces : tuple of BinaryPiece
    notes : tuple of str
    """

    path: Path
    points: np.ndarray
    pieces: tuple[BinaryPiece, ...]
    notes: tuple[str, ...] = ()

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        changed, file = ~(points == self.points), files.add(target)
        shutil.copyfile(self.path, file)
        check_columns(changed, [piece.columns for piece in self.pieces])
        with open(file, "r+b") as out, mmap.mmap(out.fileno(), 0) as data:
            for piece in self.pieces:
                if piece.rows.stop > piece.rows.start:
                    which = changed[piece.rows, piece.columns]
                    piece.view(data)[which] = points[piece.rows, piece.columns][which]
            data.flush()
        return self.notes + precision_notes(changed, [piece.dtype for piece in self.pieces])


def check_columns(changed: np.ndarray, columns: list[slice]) -> None:
    """Raise `CoordinatesError` if coordinates have changed that the file does not have."""
    present = np.zeros(3, bool)
    for part in columns:
        present[part] = True
    if changed[:, ~present].any():
        raise CoordinatesError("nodes have left the plane that the file describes")


def precision_notes(changed: np.ndarray, dtypes: list[np.dtype]) -> tuple[str, ...]:
    """Return the note for new coordinates of less than 64 bits; none where there are none."""
    return (SINGLE_PRECISION,) if changed.any() and any(dtype.itemsize < 8 for dtype in dtypes) else ()


def locate_datasets(
    path: Path, points: np.ndarray, datasets: list[tuple[object, slice]], notes: tuple[str, ...] = ()
) -> BinaryCoordinates | HDF5Coordinates:
    """Return the coordinates of an open file: as places in it where its datasets lie in one piece each.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    datasets : list of (h5py.Dataset, slice)
        Each with the coordinates that it holds, one after the other for all nodes.
    notes : tuple of str
    """
    offsets = [dataset.id.get_offset() for dataset, _ in datasets]  # None unless the values lie in one piece
    if None in offsets:
        named = [(dataset.name, dataset.dtype, columns) for dataset, columns in datasets]
        return HDF5Coordinates(path, points, named, notes)
    parts = zip(offsets, datasets, strict=True)
    pieces = (BinaryPiece.of_columns(offset, one.dtype, len(points), columns) for offset, (one, columns) in parts)
    return BinaryCoordinates(path, points, tuple(pieces), notes)


@dataclass(frozen=True, eq=False)
class HDF5Coordinates:
    """Coordinates in chunks or compressed, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    The library writes them into a copy of the file: all other values stay, though not each byte.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    datasets : list of (str, numpy dtype, slice)
        Names and types of datasets, and the coordinates that each holds.
    notes : tuple of str
    """

    path: Path
    points: np.ndarray
    datasets: list[tuple[str, np.dtype, slice]]
    notes: tuple[str, ...] = ()

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        changed, file = ~(points == self.points), files.add(target)
        check_columns(changed, [columns for *_, columns in self.datasets])
        shutil.copyfile(self.path, file)
        with hdf5.library_errors(self.path), writable_file(file, "r+") as out:
            for name, _, columns in self.datasets:
                out[name][...] = points[:, columns].T.reshape(out[name].shape)
        return self.notes + precision_notes(changed, [dtype for _, dtype, _ in self.datasets])
