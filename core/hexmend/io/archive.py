"""A tree of plain data and arrays as one file: a zip with a description in JSON and an .npy of every array.

Nothing in it is ever run, and nothing is compressed, so that no file takes more memory than its own size and that of
its text. An array that is in several places of the tree is written once, and is one array again when it is read.
"""

from __future__ import annotations

import json
import math
import os
import re
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from hexmend.errors import FileError

#: The member that describes the others; it comes first, and is no larger than this many bytes.
DESCRIPTION = "description.json"
LARGEST = 256 << 20

_MEMBER = re.compile(r"arrays/(0|[1-9]\d{0,8})\.npy")
#: What stands for an array in the description. Names that begin with its first letter get another one before them.
_ARRAY = "$array"
#: Kinds of numpy's types that are only data.
_KINDS = "biufcSU"
#: The head of an .npy as it is written here: numpy's own reader of heads takes more, and fails in more ways.
_HEAD = re.compile(
    rb"\{'descr': '(?P<type>[<>|][biufcSU]\d{1,9})', 'fortran_order': (?P<columns>True|False), "
    rb"'shape': \((?P<shape>(\d{1,18},? ?){0,32})\), \} *\n"
)
_MAGIC = b"\x93NUMPY\x01\x00"
#: Bytes that are read at once.
_AT_ONCE = 1 << 24
_NOT_OURS = "Name a file that Hexmend wrote."
_REMEDY = "Use an earlier copy, or open the mesh that it was made from."


def write_archive(path: str | os.PathLike[str], format: str, version: int, data: Any) -> None:
    """Write a tree of None, bool, int, float, str, list, dict by str, and arrays.

    Raises
    ------
    FileError
        For a value of another kind.
    """
    arrays: dict[int, tuple[int, np.ndarray]] = {}
    try:
        description = {"format": format, "version": version, "data": _encoded(data, arrays)}
    except TypeError as error:
        raise FileError(path, f"cannot hold {error}") from None
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr(DESCRIPTION, json.dumps(description))
        for number, array in arrays.values():
            with archive.open(f"arrays/{number}.npy", "w", force_zip64=True) as member:
                _write(member, array)


def _write(member: IO[bytes], array: np.ndarray) -> None:
    """Write an array as .npy, large ones without a copy, so that other threads go on meanwhile."""
    if not array.flags.c_contiguous or not array.nbytes:
        np.lib.format.write_array(member, array, version=(1, 0), allow_pickle=False)
        return
    np.lib.format.write_array_header_1_0(member, np.lib.format.header_data_from_array_1_0(array))
    data = memoryview(array.reshape(-1).view(np.uint8))
    for at in range(0, len(data), _AT_ONCE):
        member.write(data[at : at + _AT_ONCE])


def read_archive(path: str | os.PathLike[str], format: str, version: int) -> tuple[int, Any]:
    """The version and the tree that `write_archive` wrote.

    Parameters
    ----------
    path : path-like
    format : str
        What the file has to be.
    version : int
        The newest that is read.

    Raises
    ------
    FileError
        For whatever is no such file, is damaged, is newer, or holds anything but data.
    """
    path = Path(path)
    try:
        with zipfile.ZipFile(path) as archive:
            members = _members(path, archive)
            description = json.loads(archive.read(DESCRIPTION))
            number, tree = _checked(path, description, format, version)
            return number, _decoded(tree, _Arrays(path, archive, members))
    except (zipfile.BadZipFile, EOFError) as error:
        raise FileError(path, f"is damaged or not whole: {_small(error)}", _REMEDY) from None
    except RecursionError:
        raise FileError(path, f"{DESCRIPTION} is nested too deeply", _REMEDY) from None
    except (
        ValueError,
        TypeError,
        OverflowError,
        NotImplementedError,
        RuntimeError,
    ) as error:  # of json, numpy, zipfile
        raise FileError(path, f"is damaged: {_small(error)}", _REMEDY) from None


def _small(error: Exception) -> str:
    words = str(error) or type(error).__name__
    return words[:1].lower() + words[1:200]


def _members(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """The members by name, once it is known that together they are no larger than the file."""
    members, room = {}, path.stat().st_size
    for info in archive.infolist():
        name = info.filename
        if name != DESCRIPTION and not _MEMBER.fullmatch(name):
            raise FileError(
                path, f"holds {name[:80]!r}, which Hexmend does not know", "Name a file that Hexmend wrote."
            )
        if name in members:
            raise FileError(path, f"holds {name} twice", _REMEDY)
        if info.compress_type != zipfile.ZIP_STORED or info.file_size != info.compress_size:
            raise FileError(path, f"{name} is compressed: expected what Hexmend wrote, which is not", _REMEDY)
        members[name], room = info, room - info.file_size
    if room < 0:
        raise FileError(path, f"says that it holds {-room:,} bytes more than it has", _REMEDY)
    if DESCRIPTION not in members:
        raise FileError(path, f"has no {DESCRIPTION}", _NOT_OURS)
    if members[DESCRIPTION].file_size > LARGEST:
        raise FileError(path, f"{DESCRIPTION} is larger than {LARGEST >> 20} MB", _REMEDY)
    return members


def _checked(path: Path, description: Any, format: str, version: int) -> tuple[int, Any]:
    """The version, which is known, and the tree of a description of the format."""
    if not isinstance(description, dict) or description.get("format") != format:
        raise FileError(path, f"is no {format}", _NOT_OURS)
    number = description.get("version")
    if type(number) is not int or number < 1:
        raise FileError(path, f"has the version {str(number)[:20]!r}: expected a number from 1 to {version}", _REMEDY)
    if number > version:
        raise FileError(path, f"is of version {number}: this Hexmend reads up to {version}", "Use a newer Hexmend.")
    unknown = description.keys() - {"format", "version", "data"}
    if unknown or "data" not in description:
        what = f"has an unknown field {min(unknown)[:80]!r}" if unknown else "has no data"
        raise FileError(path, what, "Use a newer Hexmend." if unknown else _REMEDY)
    return number, description["data"]


def _encoded(value: Any, arrays: dict[int, tuple[int, np.ndarray]]) -> Any:
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "O" and all(isinstance(one, str) for one in value.flat):
            value = value.astype(str)
        if value.dtype.kind not in _KINDS:
            raise TypeError(f"an array of {value.dtype}")
        return {_ARRAY: arrays.setdefault(id(value), (len(arrays), value))[0]}
    if isinstance(value, Mapping):
        if not all(isinstance(name, str) for name in value):
            raise TypeError("a table whose keys are not names")
        return {"$" + name if name.startswith("$") else name: _encoded(one, arrays) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [_encoded(one, arrays) for one in value]
    if isinstance(value, np.generic):
        return value.item()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"a {type(value).__name__}")


def _decoded(value: Any, array: Callable[[Any], np.ndarray]) -> Any:
    if isinstance(value, list):
        return [_decoded(one, array) for one in value]
    if not isinstance(value, dict):
        return value
    if value.keys() == {_ARRAY}:
        return array(value[_ARRAY])
    return {name[1:] if name.startswith("$") else name: _decoded(one, array) for name, one in value.items()}


class _Arrays:
    """Arrays by their numbers, each read once."""

    def __init__(self, path: Path, archive: zipfile.ZipFile, members: Mapping[str, zipfile.ZipInfo]):
        self._path, self._archive, self._members = path, archive, members
        self._read: dict[int, np.ndarray] = {}

    def __call__(self, number: Any) -> np.ndarray:
        name = f"arrays/{number}.npy"
        if type(number) is not int or name not in self._members:
            raise FileError(self._path, f"names {name[:80]}, which is not in it", _REMEDY)
        if number not in self._read:
            self._read[number] = self._array(name)
        return self._read[number]

    def _array(self, name: str) -> np.ndarray:
        with self._archive.open(self._members[name]) as member:
            begin = member.read(len(_MAGIC) + 2)
            head = _HEAD.fullmatch(member.read(int.from_bytes(begin[-2:], "little")))
            if begin[:-2] != _MAGIC or head is None:
                raise FileError(self._path, f"{name} is no array of numbers or text", _REMEDY)
            dtype, columns = np.dtype(head["type"].decode()), head["columns"] == b"True"
            shape = tuple(int(length) for length in head["shape"].split(b",") if length.strip())
            left = self._members[name].file_size - member.tell()
            count = math.prod(shape)
            if count * dtype.itemsize != left:
                problem = f"{name} has the shape {shape} of {dtype}, and {left:,} bytes"
                raise FileError(self._path, problem, _REMEDY)
            array = np.empty(count, dtype)
            into = array.view(np.uint8) if left else array
            for at in range(0, left, _AT_ONCE):
                part = member.read(min(_AT_ONCE, left - at))
                into[at : at + len(part)] = np.frombuffer(part, np.uint8)
            array = array.reshape(shape, order="F" if columns else "C")
            array.flags.writeable = False
            return array
