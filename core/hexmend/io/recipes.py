"""Recipes from and to files."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hexmend.errors import FileError, ParameterError
from hexmend.io.atomic import replacing
from hexmend.io.suffixes import suffix_for
from hexmend.io.text import read_text
from hexmend.recipe import Recipe, from_toml, to_toml
from hexmend.toml_text import LARGEST

T = TypeVar("T")


def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe from a TOML file.

    Raises
    ------
    FileError
        Where the file cannot be read or is no recipe: it names the line, or the stage and the key.
    """
    return read_with(from_toml, path)


def read_with(reader: Callable[[str], T], path: str | os.PathLike[str]) -> T:
    """What a function makes of the text of a recipe, of whichever kind.

    Parameters
    ----------
    reader : callable
        Takes the text; raises `ParameterError`.
    path : path-like

    Raises
    ------
    FileError
        As `read_recipe` does.
    """
    try:
        return reader(read_text(path, "a recipe", LARGEST))
    except ParameterError as error:
        raise FileError(Path(path), str(error), "Correct the file.") from None


def write_recipe(path: str | os.PathLike[str], recipe: Recipe) -> None:
    """Write a recipe as a whole or, where that fails, leave what was there.

    Raises
    ------
    FileError
        For a suffix other than .toml, or where the place cannot be written to.
    """
    suffix_for(path, "a recipe", (".toml", ""))
    with replacing(path) as temporary:
        temporary.write_text(to_toml(recipe), encoding="utf-8")
