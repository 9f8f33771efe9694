"""Reading and writing of recipes as TOML files."""

from __future__ import annotations

import os
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.storage.toml_files import read_toml, write_toml
from hexmend.parameters import suggestion
from hexmend.run.recipe import Recipe, from_toml, to_toml


def supplied_recipes() -> dict[str, Path]:
    """Return the files of the recipes that come with Hexmend, by name.

    Returns
    -------
    dict of str to Path
        Empty if the package is installed without them.
    """
    core = Path(__file__).resolve().parents[2]
    folders = core / "hexmend_app" / "resources" / "recipes", core.parent / "resources" / "recipes"
    files = next((sorted(folder.glob("*.toml")) for folder in folders if folder.is_dir()), [])
    return {file.stem: file for file in files}


def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe from a TOML file.

    Parameters
    ----------
    path : path-like
        A file, or the name of a recipe that comes with Hexmend, such as "gentle". A file of that name is preferred.

    Raises
    ------
    FileError
        If the file cannot be read or is not a recipe; the message names the line, or the stage and the key. For an
        unknown name, it lists the names.
    """
    return read_toml(_recipe_file(Path(path)), "a recipe", from_toml)


def _recipe_file(path: Path) -> Path:
    if path.suffix or path.parent != Path() or path.exists():
        return path
    files = supplied_recipes()
    if path.name in files:
        return files[path.name]
    hint = suggestion(path.name, files)
    listed = ", ".join(files) or "none is installed"
    remedy = f"{hint[:1].upper()}{hint[1:]}Recipes of Hexmend: {listed}; a file of yours ends in .toml."
    raise FileError(path, "there is no recipe of this name", remedy)


def write_recipe(path: str | os.PathLike[str], recipe: Recipe) -> None:
    """Write a recipe to a TOML file, as a whole or not at all.

    Raises
    ------
    FileError
        For a suffix other than .toml, or if the file cannot be written.
    """
    write_toml(path, "a recipe", to_toml(recipe))
