"""HDF5 files that are written: a file system that fails, such as a full disk, does not crash the library."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import FileIO
from pathlib import Path

from hexmend.signal_guard import UNINTERRUPTED_CODE


@contextmanager
def writable_file(path: Path, mode: str = "w") -> Iterator[object]:
    """Open a file to be written, for a `with` statement; groups keep the order of their members.

    Yields
    ------
    h5py.File

    Raises
    ------
    OSError
        Where the file system fails, once the file is closed.
    """
    import h5py

    with _FailureKeepingFile(path, f"{mode}+".replace("++", "+")) as target:
        with h5py.File(target, mode, track_order=True) as file:
            yield file
        if target.error is not None:
            raise OSError(target.error.errno, target.error.strerror, str(path))


class _FailureKeepingFile(FileIO):
    """File that keeps the error of a write, and lets the library go on, which would crash later otherwise.

    Attributes
    ----------
    error : OSError or None
        The first one; nothing is written after it.
    """

    error: OSError | None = None

    def write(self, data: bytes) -> int:
        """Write all bytes."""
        view = memoryview(data).cast("B")
        done = 0
        try:
            while self.error is None and done < len(view):
                done += super().write(view[done:])
        except OSError as error:
            self.error = error
        return len(view)

    def truncate(self, size: int | None = None) -> int:
        """Change the size of the file."""
        try:
            return super().truncate(size) if self.error is None else size
        except OSError as error:
            self.error = error
            return size

    def readinto(self, buffer: memoryview) -> int:
        """Fill a buffer, with zeros where nothing was written."""
        view = memoryview(buffer).cast("B")
        done = super().readinto(view)
        if self.error is not None and done < len(view):
            view[done:] = bytes(len(view) - done)
            done = len(view)
        return done


# The library calls them, and would lose an exception of Ctrl-C: it is raised soon after.
UNINTERRUPTED_CODE.update(
    method.__code__
    for method in (_FailureKeepingFile.write, _FailureKeepingFile.truncate, _FailureKeepingFile.readinto)
)
