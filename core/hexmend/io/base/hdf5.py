"""Access to HDF5 files: readers run in a subprocess, links to other files are refused, and sizes are bounded.

HDF5 files that are written: a file system that fails, such as a full disk, does not crash the library.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from io import FileIO
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Content
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.storage.binary_rows import row_blocks
from hexmend.io.storage.file_progress import advance
from hexmend.signal_guard import UNINTERRUPTED_CODE
from hexmend.terminal_text import printable

MAGIC = b"\x89HDF\r\n\x1a\n"

_ONE_FILE = "Write all data into one file with the program that made it (links: HDF5's h5copy -f ext)."

#: Exceptions of h5py for damaged files.
_WRONG_KIND = TypeError, AttributeError, OverflowError
_FAILURES = OSError, RuntimeError, ValueError, LookupError, *_WRONG_KIND

#: Bytes of all names of groups and arrays at most, as paths.
_MOST_NAMES = 1 << 28
#: A compressed array may be this many times the size of the file; arrays of up to so many bytes are always read.
_LARGEST_RATIO, _ALWAYS_READ = 100, 1 << 28


def read_content(reader: str, path: Path) -> Content:
    """Read a file in a subprocess, which the HDF5 library may crash on a damaged file.

    Parameters
    ----------
    reader : str
        "module:function", see `hexmend.io.storage.subprocess_reader.run_reader`.
    path : Path

    Returns
    -------
    Content

    Raises
    ------
    FileError
        At once where the signature of HDF5 is missing; else from the reader, or where it crashes.
    """
    from hexmend.io.storage.subprocess_reader import run_reader

    size, at = os.path.getsize(path), 0
    with open(path, "rb") as file:
        while file.read(len(MAGIC)) != MAGIC:  # a user block may precede it
            at = 2 * at or 512
            if at >= size:
                raise FileError(path, "is not an HDF5 file", "Check its suffix, or write it again: it may be damaged.")
            file.seek(at)
    return run_reader(reader, path)


@contextmanager
def library_errors(path: Path) -> Iterator[None]:
    """Context manager that turns errors of the library on a damaged file into a `FileError`."""
    try:
        yield
    except _FAILURES as error:
        if getattr(error, "filename", None):  # of a file that is written
            raise
        problem = f"cannot be read as HDF5 ({' '.join(str(error).split())[:160]})"
        if isinstance(error, _WRONG_KIND):  # a link to nothing, an attribute of another type
            problem = "holds groups or attributes that its format does not have"
        raise FileError(path, problem, DAMAGED) from None


@contextmanager
def open_file(path: Path) -> Iterator[object]:
    """Open a file for a `with` statement; every reader of a format on HDF5 does it by this function.

    Errors of the library in the block become a `FileError`.

    Yields
    ------
    h5py.File

    Raises
    ------
    FileError
        Where the library cannot read the file, or a part of it lies in another file.
    """
    import h5py

    with library_errors(path), h5py.File(path, "r") as file:
        _check_self_contained(path, file)
        yield file


def _check_self_contained(path: Path, file: object) -> None:
    """Raise a `FileError` where a link or a dataset refers to another file, even if it is not read.

    The library would open any file that is named there, even a pipe, and its bytes would become values of the mesh.
    Soft links stay inside the file. A virtual dataset is refused even if its sources lie in the same file: no writer
    of these formats makes one, and a dataset that refers to itself crashes the library.
    """
    links: list[tuple[bytes, int]] = []  # without calls of the library, whose errors would be lost in its own call
    left = _MOST_NAMES

    def keep(name: bytes, link: object) -> bool | None:
        nonlocal left
        left -= len(name)
        links.append((name, link.type))
        return True if left < 0 else None

    if file.id.links.visit(keep, info=True):
        problem = f"the names of its groups and arrays take more than {_MOST_NAMES >> 20} MB"
        raise FileError(path, problem, "Write it with fewer levels of groups.")
    for name, kind in links:
        if problem := _external(file.id, name, kind):
            raise FileError(path, f"its {_title(name)} {problem}: no other file is opened", _ONE_FILE)


def _external(group: object, name: bytes, kind: int) -> str:
    """Describe how a link of a group, or its dataset, refers to another file; empty if it does not."""
    import h5py

    if kind == h5py.h5l.TYPE_SOFT:
        return ""
    if kind == h5py.h5l.TYPE_EXTERNAL:
        other, place = group.links.get_val(name)
        return f"is an external link to {_title(place)} in the file {_title(other)}"
    if kind != h5py.h5l.TYPE_HARD:
        return f"is a link of the type {kind}, which a program has defined for itself"
    if h5py.h5o.get_info(group, name).type != h5py.h5o.TYPE_DATASET:
        return ""
    layout = h5py.h5d.open(group, name).get_create_plist()
    if layout.get_external_count():
        return f"has its values in another file, {_title(layout.get_external(0)[0])} (external storage)"
    if layout.get_layout() == h5py.h5d.VIRTUAL:
        other = layout.get_virtual_filename(0) if layout.get_virtual_count() else ""
        return f"is a virtual dataset with data in the file {_title(other)}"
    return ""


def _title(name: bytes | str) -> str:
    """Quote the name of a file or an object for a message, printable and of 80 characters at most."""
    name = printable(name.decode("utf-8", "replace") if isinstance(name, bytes) else name)
    return repr(f"{name[:80]}..." if len(name) > 80 else name)


def read_dataset(path: Path, dataset: object, row: int | None = None) -> np.ndarray:
    """Read a dataset after a check that it is not larger than a file of this size can hold.

    Parameters
    ----------
    path : Path
        Of the file.
    dataset : h5py.Dataset
    row : int, optional
        The only row that is read, such as a time step.

    Returns
    -------
    array

    Raises
    ------
    FileError
        For a dataset that is too large.
    """
    bound = max(_ALWAYS_READ, _LARGEST_RATIO * os.path.getsize(path))
    size = dataset.size if row is None else math.prod(dataset.shape[1:])
    n_bytes = None if size is None else size * dataset.dtype.itemsize
    if n_bytes is not None and n_bytes <= bound:
        values = dataset[() if row is None else row]
        advance(n_bytes, os.path.getsize(path))
        return values
    problem = f"{dataset.name} would have {size} values: more than a file of its size holds"
    raise FileError(path, problem, "Write the file again without compression, if it is true.")


def dataset_blocks(dataset: object, rows: slice) -> Iterator[tuple[slice, np.ndarray]]:
    """Read rows of a dataset block by block, whole chunks of the file at a time, and report the progress.

    Parameters
    ----------
    dataset : h5py.Dataset
        Of one axis at least.
    rows : slice
        Within the dataset.

    Yields
    ------
    part : slice
        Of the rows, counted from the first that is read.
    values : (k, ...) array
        In the byte order of the file.
    """
    step = row_blocks(len(dataset), dataset.dtype.itemsize * math.prod(dataset.shape[1:]))[:1]
    step = step[0].stop if step else 1
    if dataset.chunks:
        step += -step % dataset.chunks[0]
    total = dataset.file.id.get_filesize()
    for begin in range(rows.start, rows.stop, step):
        end = min(begin + step, rows.stop)
        values = dataset[begin:end]
        advance(values.nbytes, total)
        yield slice(begin - rows.start, end - rows.start), values


def text_of(value: str | bytes) -> str:
    """Decode a text of a file: up to the first zero byte, stripped."""
    value = value if isinstance(value, str) else bytes(value).decode("utf-8", errors="replace")
    return value.split("\0")[0].strip()


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
