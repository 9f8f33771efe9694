"""What people write as TOML (recipes, studies, scenes) from and to files."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hexmend.errors import FileError, ParameterError
from hexmend.io.base.text import read_text
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.toml_text import MAX_CHARACTERS

T = TypeVar("T")


def read_toml(path: str | os.PathLike[str], what: str, made: Callable[[str], T], largest: int = MAX_CHARACTERS) -> T:
    """What a function makes of the text of a file.

    Parameters
    ----------
    path : path-like
    what : str
        What the file is to hold, such as "a recipe".
    made : callable
        Takes the text; raises `ParameterError`.
    largest : int
        Letters that such a text may have.

    Raises
    ------
    FileError
        Where the file cannot be read, is larger, or is not what it is to be: it names the line, or the table and key.
    """
    try:
        return made(read_text(path, what, largest))
    except ParameterError as error:
        raise FileError(Path(path), str(error), "Correct the file.") from None


def write_toml(path: str | os.PathLike[str], what: str, text: str) -> None:
    """Write a text as a whole or, where that fails, leave what was there.

    Parameters
    ----------
    path : path-like
    what : str
        What it is, such as "a recipe".
    text : str

    Raises
    ------
    FileError
        For a suffix other than .toml, or where the place cannot be written to.
    """
    suffix_for(path, what, (".toml", ""))
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
