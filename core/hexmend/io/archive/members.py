"""The members of an archive, of a zip or of a folder, and the arrays in them: untrusted, and never more than data."""

from __future__ import annotations

import math
import os
import re
import stat
import zipfile
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import FileError

#: The member that describes the others; in a zip it comes first. It is no larger than this many bytes.
DESCRIPTION = "description.json"
LARGEST = 256 << 20

#: What to do about a file that is damaged, and about one that is another's.
REMEDY = "Use an earlier copy, or open the mesh that it was made from."
NOT_OURS = "Name a file that Hexmend wrote."

#: What the folder of arrays is called, in a zip too.
ARRAYS = "arrays"
MEMBER = re.compile(rf"{ARRAYS}/(0|[1-9]\d{{0,8}})\.npy")
#: The head of an .npy as it is written here: numpy's own reader of heads takes more, and fails in more ways.
_HEAD = re.compile(
    rb"\{'descr': '(?P<type>[<>|][biufcSU]\d{1,9})', 'fortran_order': (?P<columns>True|False), "
    rb"'shape': \((?P<shape>(\d{1,18}, ?){0,32}(\d{1,18})?)\), \} *\n"
)
_MAGIC = b"\x93NUMPY\x01\x00"
#: Bytes of the longest head that is written here, of 32 axes, and some more.
_LONGEST = 1024
#: Bytes that are read at once.
_AT_ONCE = 1 << 24


class ArchiveMembers(ABC):
    """Files by name.

    Attributes
    ----------
    sizes : mapping of str to int
        In bytes.
    """

    sizes: Mapping[str, int]

    @abstractmethod
    def open(self, name: str) -> IO[bytes]:
        """One of them, to be read."""


class _OfZip(ArchiveMembers):
    def __init__(self, path: Path, archive: zipfile.ZipFile):
        self._archive, self._infos = archive, _checked(path, archive)
        self.sizes = {name: info.file_size for name, info in self._infos.items()}

    def open(self, name: str) -> IO[bytes]:
        return self._archive.open(self._infos[name])


class _OfFolder(ArchiveMembers):
    """What stands in a folder besides is passed over: what was being written when its writer was killed."""

    def __init__(self, path: Path):
        self._path, self.sizes = path, {}
        for folder, start in ((path, ""), (path / ARRAYS, f"{ARRAYS}/")):
            for entry in os.scandir(folder) if folder.is_dir() else ():
                about, name = entry.stat(follow_symlinks=False), start + entry.name
                if stat.S_ISREG(about.st_mode) and (name == DESCRIPTION or MEMBER.fullmatch(name)):
                    self.sizes[name] = about.st_size

    def open(self, name: str) -> IO[bytes]:
        return open(self._path / name, "rb")


@contextmanager
def open_members(path: Path) -> Iterator[ArchiveMembers]:
    """The members of a zip or of a folder, one of which is the description.

    Raises
    ------
    FileError
        Where that is missing or too large, or a zip holds what does not belong there.
    zipfile.BadZipFile
    """
    if path.is_dir():
        members = _OfFolder(path)
        _check(path, members)
        yield members
        return
    with zipfile.ZipFile(path) as archive:
        members = _OfZip(path, archive)
        _check(path, members)
        yield members


def _check(path: Path, members: ArchiveMembers) -> None:
    if DESCRIPTION not in members.sizes:
        raise FileError(path, f"has no {DESCRIPTION}", NOT_OURS)
    if members.sizes[DESCRIPTION] > LARGEST:
        raise FileError(path, f"{DESCRIPTION} is larger than {LARGEST >> 20} MB", REMEDY)


def _checked(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """A zip's members by name, once it is known that together they are no larger than the file."""
    members, room = {}, path.stat().st_size
    for info in archive.infolist():
        name = info.filename
        if name != DESCRIPTION and not MEMBER.fullmatch(name):
            raise FileError(path, f"holds {name[:80]!r}, which Hexmend does not know", NOT_OURS)
        if name in members:
            raise FileError(path, f"holds {name} twice", REMEDY)
        if info.compress_type != zipfile.ZIP_STORED or info.file_size != info.compress_size:
            raise FileError(path, f"{name} is compressed: expected what Hexmend wrote, which is not", REMEDY)
        members[name], room = info, room - info.file_size
    if room < 0:
        raise FileError(path, f"says that it holds {-room:,} bytes more than it has", REMEDY)
    return members


class ArrayReader:
    """Arrays by their numbers, each read once."""

    def __init__(self, path: Path, members: ArchiveMembers):
        self._path, self._members = path, members
        self._read: dict[int, np.ndarray] = {}

    def __call__(self, number: Any) -> np.ndarray:
        name = f"{ARRAYS}/{number}.npy"
        if type(number) is not int or name not in self._members.sizes:
            raise FileError(self._path, f"names {name[:80]}, which is not in it", REMEDY)
        if number not in self._read:
            self._read[number] = self._array(name)
        return self._read[number]

    def _array(self, name: str) -> np.ndarray:
        with self._members.open(name) as member:
            begin = member.read(len(_MAGIC) + 2)
            length = int.from_bytes(begin[-2:], "little")
            head = _HEAD.fullmatch(member.read(length)) if length <= _LONGEST else None
            if begin[:-2] != _MAGIC or head is None:
                raise FileError(self._path, f"{name} is no array of numbers or text", REMEDY)
            dtype, columns = np.dtype(head["type"].decode()), head["columns"] == b"True"
            shape = tuple(int(length) for length in head["shape"].split(b",") if length.strip())
            left = self._members.sizes[name] - member.tell()
            count = math.prod(shape)
            if not dtype.itemsize or count * dtype.itemsize != left:  # numpy makes room for text of no letters too
                problem = f"{name} has the shape {shape} of {dtype}, and {left:,} bytes"
                raise FileError(self._path, problem, REMEDY)
            array = np.empty(count, dtype)
            into = array.view(np.uint8) if left else array
            for at in range(0, left, _AT_ONCE):
                part = member.read(min(_AT_ONCE, left - at))
                into[at : at + len(part)] = np.frombuffer(part, np.uint8)
            return as_immutable(array.reshape(shape, order="F" if columns else "C"))  # meshes share it
