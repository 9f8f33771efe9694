"""Members of an archive (a zip file or a folder) and their arrays; the input is not trusted."""

from __future__ import annotations

import math
import os
import re
import stat
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import FileError

#: Member that describes the tree; in a zip file it comes first.
DESCRIPTION = "description.json"
#: Largest size of the description in bytes.
LARGEST = 256 << 20

#: Remedies for a damaged file, and for a file of another program.
REMEDY = "Use an earlier copy, or open the mesh that it was made from."
NOT_OURS = "Choose a file that Hexmend wrote."

#: Folder of the arrays, in zip files too.
ARRAYS = "arrays"
MEMBER = re.compile(rf"{ARRAYS}/(0|[1-9]\d{{0,8}})\.npy")
#: Header of an .npy file from `write_archive`; NumPy's own parser accepts more and fails in more ways.
_HEADER = re.compile(
    rb"\{'descr': '(?P<type>[<>|][biufcSU]\d{1,9})', 'fortran_order': (?P<columns>True|False), "
    rb"'shape': \((?P<shape>(\d{1,18}, ?){0,32}(\d{1,18})?)\), \} *\n"
)
_MAGIC = b"\x93NUMPY\x01\x00"
#: Longest header in bytes, for 32 axes.
_LONGEST_HEADER = 1024
#: Bytes that are read at a time.
_CHUNK = 1 << 24


class ArchiveMembers(NamedTuple):
    """Members by name.

    Parameters
    ----------
    sizes : mapping of str to int
        Sizes in bytes.
    open : callable
        open(name) opens a member for reading.
    """

    sizes: Mapping[str, int]
    open: Callable[[str], IO[bytes]]


def _zip_members(path: Path, archive: zipfile.ZipFile) -> ArchiveMembers:
    infos = _checked(path, archive)
    sizes = {name: info.file_size for name, info in infos.items()}
    return ArchiveMembers(sizes, lambda name: archive.open(infos[name]))


def _folder_members(path: Path) -> ArchiveMembers:
    """Return the members in a folder; other files, such as remains of a killed writer, are ignored."""
    sizes = {}
    for folder, start in ((path, ""), (path / ARRAYS, f"{ARRAYS}/")):
        for entry in os.scandir(folder) if folder.is_dir() else ():
            about, name = entry.stat(follow_symlinks=False), start + entry.name
            if stat.S_ISREG(about.st_mode) and (name == DESCRIPTION or MEMBER.fullmatch(name)):
                sizes[name] = about.st_size
    return ArchiveMembers(sizes, lambda name: open(path / name, "rb"))


@contextmanager
def open_members(path: Path) -> Iterator[ArchiveMembers]:
    """Open the members of a zip file or a folder for a `with` statement.

    Yields
    ------
    ArchiveMembers
        One of them is the description.

    Raises
    ------
    FileError
        Where the description is missing or too large, or a zip file holds unknown members.
    zipfile.BadZipFile
        Where the file is not a zip file.
    """
    with ExitStack() as stack:
        is_folder = path.is_dir()
        members = _folder_members(path) if is_folder else _zip_members(path, stack.enter_context(zipfile.ZipFile(path)))
        if DESCRIPTION not in members.sizes:
            raise FileError(path, f"has no {DESCRIPTION}", NOT_OURS)
        if members.sizes[DESCRIPTION] > LARGEST:
            raise FileError(path, f"{DESCRIPTION} is larger than {LARGEST >> 20} MB", REMEDY)
        yield members


def _checked(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Members of a zip file by name, after a check that together they are not larger than the file."""
    members, left = {}, path.stat().st_size
    for info in archive.infolist():
        name = info.filename
        if name != DESCRIPTION and not MEMBER.fullmatch(name):
            raise FileError(path, f"holds {name[:80]!r}, which Hexmend does not know", NOT_OURS)
        if name in members:
            raise FileError(path, f"holds {name} twice", REMEDY)
        if info.compress_type != zipfile.ZIP_STORED or info.file_size != info.compress_size:
            raise FileError(path, f"{name} is compressed: expected what Hexmend wrote, which is not", REMEDY)
        members[name], left = info, left - info.file_size
    if left < 0:
        raise FileError(path, f"declares {-left:,} bytes more than it has", REMEDY)
    return members


class ArrayReader:
    """Arrays by number, each read once; call it with the number."""

    def __init__(self, path: Path, members: ArchiveMembers):
        self._path, self._members = path, members
        self._read: dict[int, np.ndarray] = {}

    def __call__(self, number: Any) -> np.ndarray:
        name = f"{ARRAYS}/{number}.npy"
        if type(number) is not int or name not in self._members.sizes:
            raise FileError(self._path, f"refers to {name[:80]}, which it does not contain", REMEDY)
        if number not in self._read:
            self._read[number] = self._array(name)
        return self._read[number]

    def _array(self, name: str) -> np.ndarray:
        with self._members.open(name) as member:
            start = member.read(len(_MAGIC) + 2)
            length = int.from_bytes(start[-2:], "little")
            header = _HEADER.fullmatch(member.read(length)) if length <= _LONGEST_HEADER else None
            if start[:-2] != _MAGIC or header is None:
                raise FileError(self._path, f"{name} is not an array of numbers or text", REMEDY)
            dtype, columns = np.dtype(header["type"].decode()), header["columns"] == b"True"
            shape = tuple(int(length) for length in header["shape"].split(b",") if length.strip())
            left = self._members.sizes[name] - member.tell()
            count = math.prod(shape)
            if not dtype.itemsize or count * dtype.itemsize != left:  # NumPy would allocate strings of length 0
                problem = f"{name} has the shape {shape} of {dtype}, and {left:,} bytes"
                raise FileError(self._path, problem, REMEDY)
            array = np.empty(count, dtype)
            buffer = array.view(np.uint8) if left else array
            for at in range(0, left, _CHUNK):
                part = member.read(min(_CHUNK, left - at))
                buffer[at : at + len(part)] = np.frombuffer(part, np.uint8)
            return as_immutable(array.reshape(shape, order="F" if columns else "C"))  # several meshes may share it
