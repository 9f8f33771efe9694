"""Trees of plain data and arrays as a zip file: a description in JSON and an .npy file for each array.

Reading never executes code, and nothing is compressed, so that a file needs no more memory than its own size and that
of its text. An array that occurs several times in the tree is written once, and read as one array.
"""

from __future__ import annotations

import json
import math
import re
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import FileError

#: Member that describes the tree; it comes first.
DESCRIPTION = "description.json"
#: Largest size of the description in bytes.
LARGEST = 256 << 20

#: Remedies for a damaged file, and for a file of another program.
REMEDY = "Use an earlier copy, or open the mesh that it was made from."
NOT_OURS = "Choose a file that Hexmend wrote."

#: Folder of the arrays.
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

#: Key of an array's number in the description. A further "$" precedes keys of the tree that begin with "$".
_ARRAY = "$array"
#: Kinds of NumPy types that are plain data.
_KINDS = "biufcSU"


def write_archive(path: str | Path, format: str, version: int, data: Any) -> None:
    """Write a tree of None, bool, int, float, str, list, dict with str keys, and arrays.

    Parameters
    ----------
    path : path-like
    format : str
        Name of the kind of file, such as "Hexmend session".
    version : int
    data : object
        The tree.

    Raises
    ------
    FileError
        For a value of another type.
    """
    arrays: dict[int, tuple[int, np.ndarray]] = {}  # by id: the number and the array

    def number(array: np.ndarray) -> int:
        return arrays.setdefault(id(array), (len(arrays), array))[0]

    try:
        description = json.dumps({"format": format, "version": version, "data": _encode(data, number)})
    except TypeError as error:
        raise FileError(path, f"cannot hold {error}") from None
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr(DESCRIPTION, description)
        for at, array in arrays.values():
            with archive.open(f"{ARRAYS}/{at}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, array, version=(1, 0), allow_pickle=False)


def read_archive(path: str | Path, format: str, version: int) -> Any:
    """Read a file from `write_archive`; its content is not trusted.

    Parameters
    ----------
    path : path-like
    format : str
        Expected kind of file.
    version : int
        Expected version.

    Returns
    -------
    object
        The tree.

    Raises
    ------
    FileError
        For a file of another kind or version, or damaged.
    """
    path = Path(path)
    try:
        with zipfile.ZipFile(path) as archive:
            members = _checked_members(path, archive)
            tree = _check(path, json.loads(archive.read(DESCRIPTION)), format, version)
            return _decode(tree, _ArrayReader(path, archive, members))
    except (zipfile.BadZipFile, EOFError) as error:
        raise FileError(path, f"is damaged or incomplete: {_decapitalise(error)}", REMEDY) from None
    except RecursionError:
        raise FileError(path, f"{DESCRIPTION} is nested too deeply", REMEDY) from None
    except MemoryError:
        raise FileError(path, "does not fit into memory", "Close other programs.") from None
    except (ValueError, TypeError, OverflowError, RuntimeError) as error:  # of json, numpy, zipfile
        raise FileError(path, f"is damaged: {_decapitalise(error)}", REMEDY) from None


def _decapitalise(error: Exception) -> str:
    message = str(error) or type(error).__name__
    return message[:1].lower() + message[1:200]


def _check(path: Path, description: Any, format: str, version: int) -> Any:
    """Check the format and version of a description; returns the tree."""
    if not isinstance(description, dict) or description.get("format") != format:
        raise FileError(path, f"is not a {format}", NOT_OURS)
    number = description.get("version")
    if type(number) is not int or number != version:
        problem = f"is of version {repr(number)[:20]}: expected {version}"
        raise FileError(path, problem, "Use the Hexmend that wrote it.")
    unknown = description.keys() - {"format", "version", "data"}
    if unknown or "data" not in description:
        label = f"has an unknown field {min(unknown)[:80]!r}" if unknown else "has no data"
        raise FileError(path, label, REMEDY)
    return description["data"]


def _encode(value: Any, number: Callable[[np.ndarray], int]) -> Any:
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "O" and all(isinstance(text, str) for text in value.flat):
            value = value.astype(str)
        if value.dtype.kind not in _KINDS:
            raise TypeError(f"an array of {value.dtype}")
        return {_ARRAY: number(value)}
    if isinstance(value, Mapping):
        if not all(isinstance(name, str) for name in value):
            raise TypeError("a table whose keys are not names")
        return {"$" + name if name.startswith("$") else name: _encode(item, number) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_encode(item, number) for item in value]
    if isinstance(value, np.generic):
        return value.item()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"a {type(value).__name__}")


def _decode(value: Any, array: Callable[[Any], np.ndarray]) -> Any:
    if isinstance(value, list):
        return [_decode(item, array) for item in value]
    if not isinstance(value, dict):
        return value
    if value.keys() == {_ARRAY}:
        return array(value[_ARRAY])
    return {name[1:] if name.startswith("$") else name: _decode(item, array) for name, item in value.items()}


def _checked_members(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Return the members by name, once they are known not to be larger together than the file."""
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
    if DESCRIPTION not in members:
        raise FileError(path, f"has no {DESCRIPTION}", NOT_OURS)
    if members[DESCRIPTION].file_size > LARGEST:
        raise FileError(path, f"{DESCRIPTION} is larger than {LARGEST >> 20} MB", REMEDY)
    return members


class _ArrayReader:
    """Arrays by number, each read once; call it with the number."""

    def __init__(self, path: Path, archive: zipfile.ZipFile, members: dict[str, zipfile.ZipInfo]):
        self._path, self._archive, self._members = path, archive, members
        self._read: dict[int, np.ndarray] = {}

    def __call__(self, number: Any) -> np.ndarray:
        name = f"{ARRAYS}/{number}.npy"
        if type(number) is not int or name not in self._members:
            raise FileError(self._path, f"refers to {name[:80]}, which it does not contain", REMEDY)
        if number not in self._read:
            self._read[number] = self._array(name)
        return self._read[number]

    def _array(self, name: str) -> np.ndarray:
        with self._archive.open(name) as member:
            start = member.read(len(_MAGIC) + 2)
            length = int.from_bytes(start[-2:], "little")
            header = _HEADER.fullmatch(member.read(length)) if length <= _LONGEST_HEADER else None
            if start[:-2] != _MAGIC or header is None:
                raise FileError(self._path, f"{name} is not an array of numbers or text", REMEDY)
            dtype, columns = np.dtype(header["type"].decode()), header["columns"] == b"True"
            shape = tuple(int(length) for length in header["shape"].split(b",") if length.strip())
            left = self._members[name].file_size - member.tell()
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
