"""TOML files: recipes, studies, scenes."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hexmend.errors import FileError, ParameterError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.readable import check_readable, reading
from hexmend.io.storage.suffixes import suffix_for
from hexmend.toml_text import MAX_CHARACTERS

T = TypeVar("T")


def read_toml(path: str | os.PathLike[str], label: str, parse: Callable[[str], T], largest: int = MAX_CHARACTERS) -> T:
    """Read and parse a TOML file.

    Parameters
    ----------
    path : path-like
    label : str
        Expected content for errors, such as "a recipe".
    parse : callable
        parse(text) returns the result; raises `ParameterError`.
    largest : int
        Largest number of characters.

    Returns
    -------
    object
        Result of `parse`.

    Raises
    ------
    FileError
        Where the file cannot be read, is larger, or is invalid: it names the line, or the table and key.
    """
    try:
        return parse(_read_text(Path(path), label, largest))
    except ParameterError as error:
        raise FileError(Path(path), str(error), "Correct the file.") from None


def _read_text(path: Path, label: str, largest: int) -> str:
    """Read a text file in UTF-8.

    Parameters
    ----------
    path : Path
    label : str
        Expected content for errors, such as "a recipe".
    largest : int
        Largest number of characters.

    Returns
    -------
    str

    Raises
    ------
    FileError
        Where the file cannot be read, is larger, or is not UTF-8: it names the line.
    """
    check_readable(path, label)
    try:
        with reading(path, "Choose a smaller file."), open(path, "rb") as file:
            data = file.read(4 * largest + 4)  # bytes of `largest` characters
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise FileError(path, f"is not text: line {line} holds bytes that are not UTF-8", f"Choose {label}.") from None
    if len(text) > largest:
        raise FileError(
            path, f"has {len(text):,} characters: expected {label}, of {largest:,} at most", f"Choose {label}."
        )
    return text


def write_toml(path: str | os.PathLike[str], label: str, text: str) -> None:
    """Write a TOML file; if that fails, an earlier file stays unchanged.

    Parameters
    ----------
    path : path-like
    label : str
        The content for errors, such as "a recipe".
    text : str

    Raises
    ------
    FileError
        For a suffix other than .toml, and where the file cannot be written.
    """
    suffix_for(path, label, (".toml", ""))
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
