"""Trees of plain data and arrays as a zip file: a description in JSON and an .npy file for each array.

Reading never executes code, and nothing is compressed, so that a file needs no more memory than its own size and that
of its text. An array that occurs several times in the tree is written once, and read as one array.
"""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from hexmend.errors import FileError
from hexmend_app.formats.session.members import ARRAYS, DESCRIPTION, NOT_OURS, REMEDY, ArrayReader, open_members

#: Key of an array's number in the description. A further "$" precedes keys of the tree that begin with "$".
_ARRAY = "$array"
#: Kinds of NumPy types that are plain data.
_KINDS = "biufcSU"
#: Bytes that are written at a time.
_CHUNK = 1 << 24


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

    description = encode_description(path, format, version, data, number)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr(DESCRIPTION, description)
        for at, array in arrays.values():
            with archive.open(f"{ARRAYS}/{at}.npy", "w", force_zip64=True) as member:
                write_array(member, array)


def encode_description(path: Any, format: str, version: int, data: Any, number: Callable[[np.ndarray], int]) -> str:
    """Encode the description of a tree as JSON.

    Parameters
    ----------
    path : Path
        Named in errors.
    format, version, data
        As of `write_archive`.
    number : callable
        number(array) returns the number under which an array is stored.

    Raises
    ------
    FileError
        For a value of another type.
    """
    try:
        return json.dumps({"format": format, "version": version, "data": _encode(data, number)})
    except TypeError as error:
        raise FileError(path, f"cannot hold {error}") from None


def write_array(member: IO[bytes], array: np.ndarray) -> None:
    """Write an array as .npy, without a copy and without blocking other threads for long."""
    if not array.flags.c_contiguous or not array.nbytes:
        np.lib.format.write_array(member, array, version=(1, 0), allow_pickle=False)
        return
    np.lib.format.write_array_header_1_0(member, np.lib.format.header_data_from_array_1_0(array))
    data = array.reshape(-1).view(np.uint8).data
    for at in range(0, len(data), _CHUNK):
        member.write(data[at : at + _CHUNK])


def read_archive(path: str | Path, format: str, version: int) -> Any:
    """Read a zip file from `write_archive`, or a folder from `hexmend_app.formats.session.folder`.

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
        with open_members(path) as members:
            with members.open(DESCRIPTION) as file:
                description = json.loads(file.read())
            tree = _check(path, description, format, version)
            return _decode(tree, ArrayReader(path, members))
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
