"""Recipes from and to files."""

from __future__ import annotations

import os
from pathlib import Path

from hexmend.errors import FileError, ParameterError
from hexmend.io.atomic import replacing
from hexmend.io.files import check_readable
from hexmend.io.suffixes import suffix_for
from hexmend.recipe import Recipe, from_toml, to_toml

#: Letters of a recipe, and dots in a key: a parser takes the square of these in memory.
LARGEST, DEEPEST = 1_000_000, 8


def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe from a TOML file.

    Raises
    ------
    FileError
        Where the file cannot be read or is no recipe: it names the line, or the stage and the key.
    """
    path = Path(path)
    check_readable(path, "a recipe")
    try:
        return from_toml(_shallow(path, path.read_text(encoding="utf-8-sig")))
    except ParameterError as error:
        raise FileError(path, str(error), "Correct the file.") from None
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise FileError(path, f"is not text: line {line} holds bytes that are not UTF-8", "Name a recipe.") from None
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def _shallow(path: Path, text: str) -> str:
    """The text of a recipe, once it is known to be no larger and its keys no deeper than recipes are."""
    if len(text) > LARGEST:
        raise FileError(path, f"has {len(text):,} letters: expected a recipe, of {LARGEST:,} at most", "Name a recipe.")
    for number, line in enumerate(text.splitlines(), 1):
        if line.partition("=")[0].count(".") > DEEPEST:
            raise FileError(path, f"line {number} has a key of more than {DEEPEST} parts", "Correct the file.")
    return text


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
