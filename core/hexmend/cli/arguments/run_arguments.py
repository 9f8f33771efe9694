"""The method, the limits and the surface that the options of a command name.

Checks before the work of a command begins: memory, and the files to be written.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from hexmend.cli.arguments.options import parse_settings
from hexmend.errors import FileError, InsufficientMemoryError, ParameterError
from hexmend.io import read_surface
from hexmend.io.storage.atomic import check_writable
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import AUTO, declared, from_strings
from hexmend.run import StoppingCriteria, memory
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother
from hexmend.target import SPECIFICATIONS, make_target

#: Parameters with an option of their own.
_WITH_OPTION = ("boundary", "goal", "surface_tolerance", "target", "layers")


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
        if args.method or args.set or _given_options(args):
            raise ParameterError(
                "--recipe names its methods and their values: leave out --method, --set, --boundary, --goal, "
                "--surface-tolerance, --target and --layers, or change the recipe"
            )
        return read_recipe(args.recipe).limited(**given_limits(args)), None
    name = args.method or DEFAULT_METHOD
    settings = method_settings(args, [name])
    method = from_strings(METHODS[name], settings, owner=name)
    if "size_weight" in settings and not method.weighs_sizes:
        raise ParameterError(
            f"--set size_weight={settings['size_weight']}: the target {method.target} has no sizes; name one that has "
            "(--target given-size, given, data of the file or a formula), or leave the weight out"
        )
    return method, stopping_criteria(args)


def method_settings(args: argparse.Namespace, methods: Iterable[str]) -> dict[str, str]:
    """Return the settings of --set together with those of options that set a parameter, such as --boundary.

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
    options = _given_options(args)
    if getattr(args, "surface", None) is not None and args.boundary is None and "boundary" not in settings:
        options["boundary"] = "slide"
    for key, value in options.items():
        option = f"--{key.replace('_', '-')}"
        if key in settings:
            raise ParameterError(f"{option} and --set {key}=... set the same value: leave out one of them")
        without = [name for name in methods if key not in {one.name for one in declared(METHODS[name])}]
        if without:
            raise ParameterError(f"{option} {value}: there is no such choice in {', '.join(without)}")
    return settings | options


def _given_options(args: argparse.Namespace) -> dict[str, str]:
    """Values of the options that set a parameter, by the parameter."""
    values = {name: getattr(args, name, None) for name in _WITH_OPTION}
    return {name: value for name, value in values.items() if value is not None}


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


def given_rules(args: argparse.Namespace) -> MotionRules:
    """Return the rules of motion of the options of `add_motion`."""
    return MotionRules(args.interfaces or "keep", args.fix, args.slide, args.free, args.plane, args.periodic)


def motion_rules(args: argparse.Namespace) -> MotionRules:
    """Return the rules of motion of the recipe of --recipe, followed by the options of `add_motion`."""
    if not args.recipe:
        return given_rules(args)
    return read_recipe(args.recipe).with_more_rules(given_rules(args), args.interfaces).rules


def with_surface(args: argparse.Namespace, mesh: Mesh, *methods: Smoother | Recipe) -> Mesh:
    """Return the mesh with the surface of --surface to slide on; the mesh itself without that option.

    Raises
    ------
    ParameterError
        If every method keeps the boundary fixed.
    FileError
        If the surface cannot be read.
    """
    if args.surface is None:
        return mesh
    stages = [[stage.smoother for stage in one.stages] if isinstance(one, Recipe) else [one] for one in methods]
    if not any(smoother.slides for smoothers in stages for smoother in smoothers):
        raise ParameterError("--surface is for a sliding boundary, and this one is fixed: set boundary = slide")
    return mesh.sliding_on(read_surface(args.surface))


def check_memory(
    args: argparse.Namespace, methods: Iterable[Smoother | Recipe], mesh: Mesh | int, *remedies: str
) -> None:
    """Refuse runs for which memory will not suffice; with --force only warn of them.

    Parameters
    ----------
    args : argparse.Namespace
        With `force`.
    methods : iterable of Smoother or Recipe
        They are run one after another.
    mesh : Mesh or int
        The mesh, or the number of its hexes.
    remedies : str
        Other options of the command that need less memory.

    Raises
    ------
    InsufficientMemoryError
        For the method that needs the most.
    """
    free = memory.available()
    shortages = [one for one in (memory.shortage(method, mesh, free) for method in methods) if one is not None]
    if not shortages:
        return
    worst = max(shortages, key=lambda one: one.needed)
    if not args.force:
        raise InsufficientMemoryError(f"{worst.problem} {worst.remedy(*remedies, 'run it anyway (--force)')}")
    print(f"hexmend: warning: {worst.problem}", file=sys.stderr)


def check_element_targets(methods: Iterable[Smoother | Recipe], mesh: Mesh) -> None:
    """Check that the mesh can have the targets of all methods that name data or a formula.

    Parameters
    ----------
    methods : iterable of Smoother or Recipe
    mesh : Mesh

    Raises
    ------
    ParameterError
        For the first target that the mesh cannot have.
    """
    smoothers: list[Smoother] = []
    for method in methods:
        smoothers += [stage.smoother for stage in method.stages] if isinstance(method, Recipe) else [method]
    for target in dict.fromkeys(getattr(one, "target", AUTO) for one in smoothers):
        if target not in (AUTO, *SPECIFICATIONS):
            make_target(mesh, target)


def check_targets(source: str, output: str, *targets: str | None) -> None:
    """Check that reports can be written, and that none of them would replace the mesh.

    Parameters
    ----------
    source, output : str
        The mesh file that is read and the one that is written; they may be the same.
    targets : str or None
        Other files that are written.

    Raises
    ------
    FileError
        For the first target that cannot be written or is another of the files.
    """
    taken = {os.path.realpath(source), os.path.realpath(output)}
    for path in (Path(target) for target in targets if target is not None):
        if os.path.realpath(path) in taken:
            raise FileError(path, "is the mesh, or another file to be written", "Choose another name for it.")
        check_writable(path)
        taken.add(os.path.realpath(path))
