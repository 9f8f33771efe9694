"""HDF5 files as others lay their formats in them: what is read of one is bounded by its size."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.content import Content

MAGIC = b"\x89HDF\r\n\x1a\n"

#: Compressed arrays may be that many times the size of the file, and that many bytes whatever its size.
_GROWTH, _ALWAYS = 100, 1 << 28


def content_by(reader: str, path: Path) -> Content:
    """What a reader makes of a file, in a process of its own, which the HDF5 library may end on a damaged one.

    Parameters
    ----------
    reader : str
        "module:function", as `hexmend.io.child.in_child` has it.
    path : Path

    Raises
    ------
    FileError
        At once where the file is plainly none of HDF5; else as the reader does, or where it has no answer.
    """
    from hexmend.io.child import in_child

    size, at = os.path.getsize(path), 0
    with open(path, "rb") as file:
        while file.read(len(MAGIC)) != MAGIC:  # before which a block of the program's own may stand
            at = 2 * at or 512
            if at >= size:
                raise FileError(path, "is no HDF5 file", "Check its suffix, or write it again: it may be damaged.")
            file.seek(at)
    return in_child(reader, path)


def open_file(path: Path) -> object:
    """The `h5py.File`, to be used with `with`.

    Raises
    ------
    FileError
        Where the library cannot open it.
    """
    import h5py

    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise damaged(path, error) from None


def values_of(path: Path, dataset: object) -> np.ndarray:
    """The values of a dataset, once it is known that they are not larger than a file of this size can hold."""
    bound = max(_ALWAYS, _GROWTH * os.path.getsize(path))
    try:
        size, width = dataset.size, dataset.dtype.itemsize
        if size is not None and size * width <= bound:
            return dataset[()]
    except (OSError, ValueError, TypeError, RuntimeError, IndexError) as error:
        raise damaged(path, error) from None
    raise FileError(
        path,
        f"{dataset.name} would have {size} values: more than a file of its size holds",
        "Write the file again without compression, if it is true.",
    )


def damaged(path: Path, error: Exception) -> FileError:
    """The error to raise where the library has failed."""
    detail = " ".join(str(error).split())[:160]
    return FileError(
        path,
        f"the HDF5 library cannot read it ({detail})",
        "Write the file again with the program that made it: it is damaged or cut short.",
    )
