"""Recipes from and to files."""

from __future__ import annotations

import os

from hexmend.io.storage.toml_files import read_toml, write_toml
from hexmend.run.recipe import Recipe, from_toml, to_toml


def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe from a TOML file.

    Raises
    ------
    FileError
        Where the file cannot be read or is no recipe: it names the line, or the stage and the key.
    """
    return read_toml(path, "a recipe", from_toml)


def write_recipe(path: str | os.PathLike[str], recipe: Recipe) -> None:
    """Write a recipe as a whole or, where that fails, leave what was there.

    Raises
    ------
    FileError
        For a suffix other than .toml, or where the place cannot be written to.
    """
    write_toml(path, "a recipe", to_toml(recipe))
