"""Methods and their settings from the words of a user."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hexmend.errors import ParameterError
from hexmend.parameters import declared, from_strings, suggestion
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import read_recipe, supplied_recipes
from hexmend.smoothers import METHODS, Smoother


def split_names(text: str) -> list[str]:
    """Split names at commas; the name of a recipe that comes with Hexmend is replaced by the path of its file.

    >>> split_names("laplacian, mend")
    ['laplacian', 'mend']
    """
    names = [name.strip() for name in text.split(",")]
    files = {} if all(name in METHODS for name in names) else supplied_recipes()
    return [str(files.get(name, name)) if name not in METHODS else name for name in names]


def parse_methods(
    names: Sequence[str], settings: Mapping[str, str], limits: Mapping[str, Any] | None = None
) -> list[Smoother | Recipe]:
    """Make methods of names and settings, each name once; a name that ends in `.toml` is the file of a recipe.

    Parameters
    ----------
    names : sequence of str
    settings : mapping of str to str
        `key` applies to all methods that declare it, `method.key` to one method and overrides `key`; recipes have
        their own values.
    limits : mapping, optional
        Limits of `StoppingCriteria` for the stages of recipes, in place of their own.

    Returns
    -------
    list of Smoother or Recipe

    Raises
    ------
    ParameterError
        For an unknown method, a value out of bounds, a key that none of the methods declares, or recipes with equal
        titles.
    FileError
        If a recipe cannot be read.

    Examples
    --------
    >>> methods = parse_methods(["laplacian", "local-sd", "local-nr"], {"p": "4", "local-nr.p": "6"})
    >>> [method.values().get("p") for method in methods]
    [None, 4.0, 6.0]
    """
    recipes = {name: read_recipe(name).limited(**(limits or {})) for name in names if name.endswith(".toml")}
    _check_titles(recipes)
    keys = {name: [parameter.name for parameter in declared(METHODS[name])] for name in names if name not in recipes}
    words: dict[str, dict[str, str]] = {name: {} for name in keys}
    for setting in sorted(settings, key=lambda setting: "." in setting):
        owner, dot, key = setting.rpartition(".")
        if dot and owner not in keys:
            raise ParameterError(f"{setting!r}: {owner!r} is not among the methods compared: {', '.join(keys)}")
        key = key.replace("-", "_")
        owners = [owner] if dot else [name for name in keys if key in keys[name]]
        if not owners:
            near = suggestion(key, [known for names in keys.values() for known in names]).rstrip()
            hint = f": {near}" if near else ""
            raise ParameterError(f"none of the methods {', '.join(keys)} has a parameter {key!r}{hint}")
        for name in owners:
            words[name][key] = settings[setting]
    return [
        recipes[name] if name in recipes else from_strings(METHODS[name], words[name], owner=name)
        for name in dict.fromkeys(names)
    ]


def _check_titles(recipes: Mapping[str, Recipe]) -> None:
    """Refuse recipes of one title, which tables could not tell apart."""
    owners: dict[str, str] = dict.fromkeys(METHODS, "a method") | {"initial": "the mesh as given"}
    for name, recipe in recipes.items():
        if recipe.title in owners:
            raise ParameterError(f"{name} has the title of {owners[recipe.title]}, {recipe.title!r}: change it")
        owners[recipe.title] = name
