"""Limit on the memory for the arrays of a file, so that a small damaged file cannot exhaust it."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base.remedies import DAMAGED

#: Bytes that the arrays of any file may have, and further bytes for each byte of the file. Compression reaches 650
#: for constant arrays only.
_BASE, _BYTES_PER_BYTE = 1 << 26, 100


class MemoryBudget:
    """Budget of bytes for the arrays of one file.

    Parameters
    ----------
    path : Path
        Named in errors.
    size : int
        Size of the file in bytes.
    """

    def __init__(self, path: Path, size: int):
        self.path, self.size, self.announced = path, size, 0

    def charge(self, size: int, label: str) -> None:
        """Add the announced size of an array, before it is read.

        Parameters
        ----------
        size : int
            Bytes.
        label : str
            The array, for errors.

        Raises
        ------
        FileError
            Where all arrays together exceed the budget.
        """
        self.announced += size
        if self.announced > _BASE + _BYTES_PER_BYTE * self.size:
            problem = f"{label} and the arrays before it are declared to have {self.announced >> 20:,} MB"
            raise FileError(self.path, f"{problem}: too many for a file of {max(1, self.size >> 10):,} kB", DAMAGED)
