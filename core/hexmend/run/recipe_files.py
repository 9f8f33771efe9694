"""Reading and writing of recipes as TOML files."""

from __future__ import annotations

import os

from hexmend.io.storage.toml_files import read_toml, write_toml
from hexmend.run.recipe import Recipe, from_toml, to_toml


def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe from a TOML file.

    Raises
    ------
    FileError
        If the file cannot be read or is not a recipe; the message names the line, or the stage and the key.
    """
    return read_toml(path, "a recipe", from_toml)


def write_recipe(path: str | os.PathLike[str], recipe: Recipe) -> None:
    """Write a recipe to a TOML file, as a whole or not at all.

    Raises
    ------
    FileError
        For a suffix other than .toml, or if the file cannot be written.
    """
    write_toml(path, "a recipe", to_toml(recipe))
