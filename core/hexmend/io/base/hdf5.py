"""HDF5 files as others lay their formats in them: what is read of one is bounded by its size."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Content

MAGIC = b"\x89HDF\r\n\x1a\n"

_ONE_FILE = "Write all data into one file with the program that made it (links: HDF5's h5copy -f ext)."

#: Compressed arrays may be that many times the size of the file, and that many bytes whatever its size.
_GROWTH, _ALWAYS = 100, 1 << 28


def read_content(reader: str, path: Path) -> Content:
    """What a reader makes of a file, in a process of its own, which the HDF5 library may end on a damaged one.

    Parameters
    ----------
    reader : str
        "module:function", as `hexmend.io.storage.subprocess_reader.in_child` has it.
    path : Path

    Raises
    ------
    FileError
        At once where the file is plainly none of HDF5; else as the reader does, or where it has no answer.
    """
    from hexmend.io.storage.subprocess_reader import run_reader

    size, at = os.path.getsize(path), 0
    with open(path, "rb") as file:
        while file.read(len(MAGIC)) != MAGIC:  # before which a block of the program's own may stand
            at = 2 * at or 512
            if at >= size:
                raise FileError(path, "is no HDF5 file", "Check its suffix, or write it again: it may be damaged.")
            file.seek(at)
    return run_reader(reader, path)


def open_file(path: Path) -> object:
    """The `h5py.File`, to be used with `with`; every reader of a format on HDF5 opens its file here.

    Raises
    ------
    FileError
        Where the library cannot open it, or where a part of it would be read from another file.
    """
    import h5py

    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise damaged_file(path, error) from None
    try:
        _check_self_contained(path, file)
    except FileError:
        file.close()
        raise
    return file


def _check_self_contained(path: Path, file: object) -> None:
    """Raise a `FileError` where a link or a dataset leads out of the file, be it read or not.

    The library would open whatever file is named there, even a pipe, and its bytes would become values of the mesh.
    Soft links stay inside the file. A virtual dataset is refused even where its sources lie in the same file: no
    writer of these formats makes one, and one that names itself ends the library.
    """
    links: list[tuple[bytes, int]] = []

    def visit(name: bytes, link: object) -> None:  # calls nothing of the library, whose errors would be lost in here
        links.append((name, link.type))

    try:
        file.id.links.visit(visit, info=True)
        said = next((f"{_title(name)} {way}" for name, kind in links if (way := _leads_out(file, name, kind))), "")
    except (OSError, RuntimeError, ValueError, KeyError, TypeError) as error:
        raise damaged_file(path, error) from None
    if said:
        raise FileError(path, f"its {said}: no other file is opened", _ONE_FILE)


def _leads_out(file: object, name: bytes, kind: int) -> str:
    """How a link, or the dataset that it names, leads out of the file, in words; empty where it does not."""
    import h5py

    if kind == h5py.h5l.TYPE_SOFT:
        return ""
    if kind == h5py.h5l.TYPE_EXTERNAL:
        other, place = file.id.links.get_val(name)
        return f"is an external link to {_title(place)} in the file {_title(other)}"
    if kind != h5py.h5l.TYPE_HARD:
        return f"is a link of the type {kind}, which a program has defined for itself"
    if h5py.h5o.get_info(file.id, name).type != h5py.h5o.TYPE_DATASET:
        return ""
    layout = h5py.h5d.open(file.id, name).get_create_plist()
    if layout.get_external_count():
        return f"has its values in another file, {_title(layout.get_external(0)[0])} (external storage)"
    if layout.get_layout() == h5py.h5d.VIRTUAL:
        other = layout.get_virtual_filename(0) if layout.get_virtual_count() else ""
        return f"is a virtual dataset, put together of others in the file {_title(other)}"
    return ""


def _title(name: bytes | str) -> str:
    """The name of a file, or of what is in one, for a message: quoted, printable and not too long."""
    name = name.decode("utf-8", "replace") if isinstance(name, bytes) else name
    name = "".join(letter if letter.isprintable() else "?" for letter in name)
    return repr(f"{name[:80]}..." if len(name) > 80 else name)


def read_dataset(path: Path, dataset: object) -> np.ndarray:
    """The values of a dataset, once it is known that they are not larger than a file of this size can hold."""
    bound = max(_ALWAYS, _GROWTH * os.path.getsize(path))
    try:
        size, width = dataset.size, dataset.dtype.itemsize
        if size is not None and size * width <= bound:
            return dataset[()]
    except (OSError, ValueError, TypeError, RuntimeError, IndexError) as error:
        raise damaged_file(path, error) from None
    raise FileError(
        path,
        f"{dataset.name} would have {size} values: more than a file of its size holds",
        "Write the file again without compression, if it is true.",
    )


def damaged_file(path: Path, error: Exception) -> FileError:
    """The error to raise where the library has failed."""
    detail = " ".join(str(error).split())[:160]
    return FileError(
        path,
        f"the HDF5 library cannot read it ({detail})",
        "Write the file again with the program that made it: it is damaged or cut short.",
    )
