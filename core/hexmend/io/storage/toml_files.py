"""TOML files: recipes, studies, scenes."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hexmend.errors import FileError, ParameterError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.io.storage.text_files import read_text
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
        return parse(read_text(path, label, largest))
    except ParameterError as error:
        raise FileError(Path(path), str(error), "Correct the file.") from None


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
