"""The options that say what is run: a method with its values, or a recipe, and the limits."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

from hexmend.cli.arguments.limits import add_limits, given_limits, limits

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh
    from hexmend.run import StoppingCriteria
    from hexmend.run.recipe import Recipe
    from hexmend.smoothers import Smoother


def add_method(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("--method", metavar="NAME", help="see `hexmend methods`")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="a parameter of the method")
    add_boundary(parser)
    parser.add_argument(
        "--recipe",
        metavar="FILE.toml",
        help="run these methods one after another; a limit given is for each of them",
    )
    add_limits(parser)


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Declare the options that hold for several methods: parameters, boundary, limits, memory."""
    from hexmend.cli.arguments.limits import add_limits
    from hexmend.cli.arguments.memory_check import add_force

    parser.add_argument(
        "--set",
        metavar="[METHOD.]KEY=VALUE",
        action="append",
        default=[],
        help="a parameter of the one method, or of every method that has it",
    )
    add_boundary(parser)
    add_limits(parser)
    add_force(parser)


def add_boundary(parser: argparse.ArgumentParser) -> None:
    """Declare the option that stands for `--set boundary=...`."""
    parser.add_argument(
        "--boundary",
        choices=("fixed", "slide"),
        help="whether nodes of the boundary stay, as they do by default, or slide on the surface",
    )


def add_surface(parser: argparse.ArgumentParser) -> None:
    """Declare the option that names what the boundary slides on, and that for how far it may leave it."""
    parser.add_argument(
        "--surface",
        metavar="FILE",
        help="the surface that the boundary slides on, if not itself: STL, OBJ, PLY, VTP or VTK; --boundary slide goes "
        "without saying",
    )
    parser.add_argument(
        "--surface-tolerance",
        metavar="X",
        help="how far the boundary may leave the surface, in mean edge lengths, 0 to stay on it, or the word "
        "unlimited; as --set surface_tolerance=X",
    )


def on_surface(args: argparse.Namespace, mesh: Mesh, what: Smoother | Recipe) -> Mesh:
    """The mesh, sliding on the surface that --surface names, if it does.

    Raises
    ------
    ParameterError
        Where nothing slides.
    """
    from hexmend.errors import ParameterError
    from hexmend.io import read_surface

    if args.surface is None:
        return mesh
    if not any(stage.slides for stage in ([one.smoother for one in what.stages] if args.recipe else [what])):
        raise ParameterError("--surface names what the boundary slides on, and it is fixed: say boundary = slide")
    return mesh.sliding_on(read_surface(args.surface))


def with_boundary(args: argparse.Namespace, methods: Iterable[str]) -> dict[str, str]:
    """The settings of --set, with what --boundary and --surface-tolerance say.

    Raises
    ------
    ParameterError
        Naming the methods that do not know them, or where --set says it too.
    """
    from hexmend.cli.command import settings
    from hexmend.errors import ParameterError
    from hexmend.parameters import declared
    from hexmend.smoothers import METHODS

    words, said = settings(args.set), {"boundary": args.boundary}
    said["surface_tolerance"] = getattr(args, "surface_tolerance", None)
    if getattr(args, "surface", None) is not None and args.boundary is None and "boundary" not in words:
        said["boundary"] = "slide"
    said = {key: value for key, value in said.items() if value is not None}
    for key, value in said.items():
        option = f"--{key.replace('_', '-')}"
        if key in words:
            raise ParameterError(f"{option} and --set {key}=... say the same thing: leave out one of them")
        without = [name for name in methods if key not in {one.name for one in declared(METHODS[name])}]
        if without:
            knows = "knows" if len(without) == 1 else "know"
            raise ParameterError(f"{option} {value}: {', '.join(without)} {knows} fixed boundaries alone")
    return words | said


def chosen(args: argparse.Namespace) -> tuple[Smoother | Recipe, StoppingCriteria | None]:
    """What is to be run, and its limits where it does not hold them itself."""
    from hexmend.errors import ParameterError
    from hexmend.parameters import from_strings
    from hexmend.run.recipe_files import read_recipe
    from hexmend.smoothers import DEFAULT_METHOD, METHODS

    if args.recipe:
        if args.method or args.set or args.boundary or getattr(args, "surface_tolerance", None):
            raise ParameterError(
                "--recipe names its methods and their values: leave out --method, --set, --boundary and "
                "--surface-tolerance, or change the recipe"
            )
        return read_recipe(args.recipe).limited(**given_limits(args)), None
    name = args.method or DEFAULT_METHOD
    return from_strings(METHODS[name], with_boundary(args, [name]), owner=name), limits(args)
