"""The options that say what is run: a method with its values, or a recipe, and the limits."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

from hexmend.cli.command.limits import add_limits, given_limits, limits

if TYPE_CHECKING:
    from hexmend.recipe import Recipe
    from hexmend.run import Stop
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


def add_boundary(parser: argparse.ArgumentParser) -> None:
    """Declare the option that stands for `--set boundary=...`."""
    parser.add_argument(
        "--boundary",
        choices=("fixed", "slide"),
        help="whether nodes of the boundary stay, as they do by default, or slide on the surface",
    )


def with_boundary(args: argparse.Namespace, methods: Iterable[str]) -> dict[str, str]:
    """The settings of --set, with what --boundary says, which every one of the methods must know.

    Raises
    ------
    ParameterError
        Naming the methods that do not, or where --set says it too.
    """
    from hexmend.cli.command import settings
    from hexmend.errors import ParameterError
    from hexmend.parameters import declared
    from hexmend.smoothers import METHODS

    words = settings(args.set)
    if args.boundary is None:
        return words
    if "boundary" in words:
        raise ParameterError("--boundary and --set boundary=... say the same thing: leave out one of them")
    without = [name for name in methods if "boundary" not in {one.name for one in declared(METHODS[name])}]
    if without:
        knows = "knows" if len(without) == 1 else "know"
        raise ParameterError(f"--boundary {args.boundary}: {', '.join(without)} {knows} fixed boundaries alone")
    return words | {"boundary": args.boundary}


def chosen(args: argparse.Namespace) -> tuple[Smoother | Recipe, Stop | None]:
    """What is to be run, and its limits where it does not hold them itself."""
    from hexmend.errors import ParameterError
    from hexmend.io import read_recipe
    from hexmend.parameters import from_strings
    from hexmend.smoothers import DEFAULT_METHOD, METHODS

    if args.recipe:
        if args.method or args.set or args.boundary:
            raise ParameterError(
                "--recipe names its methods and their values: leave out --method, --set and --boundary, or change the "
                "recipe"
            )
        return read_recipe(args.recipe).limited(**given_limits(args)), None
    name = args.method or DEFAULT_METHOD
    return from_strings(METHODS[name], with_boundary(args, [name]), owner=name), limits(args)
