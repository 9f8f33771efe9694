"""How much memory the arrays of a file may take: so that a small file cannot fill it, whatever it claims."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError

#: Bytes that any file may have, and how many more for each of its own: constants are packed up to 1 : 650.
_FLOOR, _RATIO = 1 << 26, 100


class MemoryBudget:
    """What is left of the bytes that a file's arrays may have.

    Parameters
    ----------
    path : Path
        Errors name it.
    size : int
        Of the file, in bytes.
    """

    def __init__(self, path: Path, size: int):
        self.path, self.size, self.announced = path, size, 0

    def charge(self, size: int, what: str) -> None:
        """Count the bytes that an array is announced to have, before it is read.

        Raises
        ------
        FileError
            Where all arrays together are more than the file can have.
        """
        self.announced += size
        if self.announced > _FLOOR + _RATIO * self.size:
            raise FileError(
                self.path,
                f"{what} and the arrays before it are announced to have {self.announced >> 20:,} MB: too many for a "
                f"file of {max(1, self.size >> 10):,} kB",
                "Write the file again with the program that made it: it is damaged or cut short.",
            )
