"""Coordinates as binary numbers in a file: the place of each, and their replacement."""

from __future__ import annotations

import mmap
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.coordinates.located import CoordinatesError

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

    def write(self, file: Path, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        changed = ~(points == self.points)
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
