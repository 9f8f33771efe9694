"""The method, the limits and the surface that the options of a command name."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from hexmend.cli.arguments.options import parse_settings
from hexmend.errors import ParameterError
from hexmend.io import read_surface
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import declared, from_strings
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother

#: Parameters of methods that have an option of their own, such as --surface-tolerance.
_SHORT_FORMS = "boundary", "goal", "surface_tolerance"


def method_and_limits(args: argparse.Namespace) -> tuple[Smoother | Recipe, StoppingCriteria | None]:
    """Return the method or recipe of the options of `add_method`, and the limits.

    Returns
    -------
    method : Smoother or Recipe
    limits : StoppingCriteria or None
        None for a recipe, whose stages have limits of their own.

    Raises
    ------
    ParameterError
        For unknown methods or parameters, values out of bounds, and options that contradict each other.
    FileError
        For a recipe that cannot be read.
    """
    if args.recipe:
        if args.method or args.set or any(getattr(args, name, None) for name in _SHORT_FORMS):
            raise ParameterError(
                "--recipe names its methods and their values: leave out --method, --set, --boundary, --goal and "
                "--surface-tolerance, or change the recipe"
            )
        return read_recipe(args.recipe).limited(**given_limits(args)), None
    name = args.method or DEFAULT_METHOD
    return from_strings(METHODS[name], method_settings(args, [name]), owner=name), stopping_criteria(args)


def method_settings(args: argparse.Namespace, methods: Iterable[str]) -> dict[str, str]:
    """Return the settings of --set together with those of --boundary, --goal, --surface and --surface-tolerance.

    Parameters
    ----------
    args : argparse.Namespace
    methods : iterable of str
        Names of the methods that are run.

    Raises
    ------
    ParameterError
        For methods without these parameters, and where --set gives them too.
    """
    settings = parse_settings(args.set)
    options = {name: getattr(args, name, None) for name in _SHORT_FORMS}
    if getattr(args, "surface", None) is not None and args.boundary is None and "boundary" not in settings:
        options["boundary"] = "slide"
    options = {key: value for key, value in options.items() if value is not None}
    for key, value in options.items():
        option = f"--{key.replace('_', '-')}"
        if key in settings:
            raise ParameterError(f"{option} and --set {key}=... set the same value: leave out one of them")
        without = [name for name in methods if key not in {one.name for one in declared(METHODS[name])}]
        if without:
            where = "only mend has goals, not" if key == "goal" else "the boundary stays fixed in"
            raise ParameterError(f"{option} {value}: {where} {', '.join(without)}")
    return settings | options


def stopping_criteria(args: argparse.Namespace) -> StoppingCriteria:
    """Return the limits: those given as options, the others at their defaults."""
    return from_strings(StoppingCriteria, _given_words(args), owner="the run")


def given_limits(args: argparse.Namespace) -> dict[str, Any]:
    """Return the limits that were given as options, by name."""
    values = stopping_criteria(args).values()
    return {name: values[name] for name in _given_words(args)}


def _given_words(args: argparse.Namespace) -> dict[str, str]:
    words = {limit.name: getattr(args, limit.name) for limit in declared(StoppingCriteria)}
    return {name: text for name, text in words.items() if text is not None}


def with_surface(args: argparse.Namespace, mesh: Mesh, method: Smoother | Recipe) -> Mesh:
    """Return the mesh with the surface of --surface to slide on; the mesh itself without that option.

    Raises
    ------
    ParameterError
        If the method keeps the boundary fixed.
    FileError
        If the surface cannot be read.
    """
    if args.surface is None:
        return mesh
    stages = [stage.smoother for stage in method.stages] if isinstance(method, Recipe) else [method]
    if not any(stage.slides for stage in stages):
        raise ParameterError("--surface is for a sliding boundary, and this one is fixed: set boundary = slide")
    return mesh.sliding_on(read_surface(args.surface))
