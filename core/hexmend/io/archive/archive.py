"""A tree of plain data and arrays as one file: a zip with a description in JSON and an .npy of every array.

Nothing in it is ever run, and nothing is compressed, so that no file takes more memory than its own size and that of
its text. An array that is in several places of the tree is written once, and is one array again when it is read.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from hexmend.errors import FileError
from hexmend.io.archive.members import ARRAYS, DESCRIPTION, NOT_OURS, REMEDY, ArrayReader, open_members

#: What stands for an array in the description. Names that begin with its first letter get another one before them.
_ARRAY = "$array"
#: Kinds of numpy's types that are only data.
_KINDS = "biufcSU"
#: Bytes that are written at once.
_AT_ONCE = 1 << 24


def write_archive(path: str | os.PathLike[str], format: str, version: int, data: Any) -> None:
    """Write a tree of None, bool, int, float, str, list, dict by str, and arrays.

    Raises
    ------
    FileError
        For a value of another kind.
    """
    arrays: dict[int, tuple[int, np.ndarray]] = {}  # by id: the number and the array

    def number(array: np.ndarray) -> int:
        return arrays.setdefault(id(array), (len(arrays), array))[0]

    description = encode_description(path, format, version, data, number)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr(DESCRIPTION, description)
        for number, array in arrays.values():
            with archive.open(f"{ARRAYS}/{number}.npy", "w", force_zip64=True) as member:
                write_array(member, array)


def encode_description(path: Path, format: str, version: int, data: Any, number: Callable[[np.ndarray], int]) -> str:
    """The description of a tree as JSON; `number` is called with each array, and says by which number it is known.

    Raises
    ------
    FileError
        For a value that is no plain data.
    """
    try:
        return json.dumps({"format": format, "version": version, "data": _encoded(data, number)})
    except TypeError as error:
        raise FileError(path, f"cannot hold {error}") from None


def write_array(member: IO[bytes], array: np.ndarray) -> None:
    """Write an array as .npy, large ones without a copy, so that other threads go on meanwhile."""
    if not array.flags.c_contiguous or not array.nbytes:
        np.lib.format.write_array(member, array, version=(1, 0), allow_pickle=False)
        return
    np.lib.format.write_array_header_1_0(member, np.lib.format.header_data_from_array_1_0(array))
    data = memoryview(array.reshape(-1).view(np.uint8))
    for at in range(0, len(data), _AT_ONCE):
        member.write(data[at : at + _AT_ONCE])


def read_archive(path: str | os.PathLike[str], format: str, version: int) -> tuple[int, Any]:
    """The version and the tree that `write_archive` wrote, or `hexmend.io.archive.folder`.

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
        with open_members(path) as members:
            with members.open(DESCRIPTION) as file:
                description = json.loads(file.read())
            number, tree = _checked(path, description, format, version)
            return number, _decoded(tree, ArrayReader(path, members))
    except (zipfile.BadZipFile, EOFError) as error:
        raise FileError(path, f"is damaged or not whole: {_small(error)}", REMEDY) from None
    except RecursionError:
        raise FileError(path, f"{DESCRIPTION} is nested too deeply", REMEDY) from None
    except MemoryError:
        raise FileError(path, "does not fit into memory", "Close other programs.") from None
    except (
        ValueError,
        TypeError,
        OverflowError,
        NotImplementedError,
        RuntimeError,
    ) as error:  # of json, numpy, zipfile
        raise FileError(path, f"is damaged: {_small(error)}", REMEDY) from None


def _small(error: Exception) -> str:
    words = str(error) or type(error).__name__
    return words[:1].lower() + words[1:200]


def _checked(path: Path, description: Any, format: str, version: int) -> tuple[int, Any]:
    """The version, which is known, and the tree of a description of the format."""
    if not isinstance(description, dict) or description.get("format") != format:
        raise FileError(path, f"is no {format}", NOT_OURS)
    number = description.get("version")
    if type(number) is not int or number < 1:
        raise FileError(path, f"has the version {str(number)[:20]!r}: expected a number from 1 to {version}", REMEDY)
    if number > version:
        raise FileError(path, f"is of version {number}: this Hexmend reads up to {version}", "Use a newer Hexmend.")
    unknown = description.keys() - {"format", "version", "data"}
    if unknown or "data" not in description:
        what = f"has an unknown field {min(unknown)[:80]!r}" if unknown else "has no data"
        raise FileError(path, what, "Use a newer Hexmend." if unknown else REMEDY)
    return number, description["data"]


def _encoded(value: Any, number: Callable[[np.ndarray], int]) -> Any:
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "O" and all(isinstance(one, str) for one in value.flat):
            value = value.astype(str)
        if value.dtype.kind not in _KINDS:
            raise TypeError(f"an array of {value.dtype}")
        return {_ARRAY: number(value)}
    if isinstance(value, Mapping):
        if not all(isinstance(name, str) for name in value):
            raise TypeError("a table whose keys are not names")
        return {"$" + name if name.startswith("$") else name: _encoded(one, number) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [_encoded(one, number) for one in value]
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
