"""The options that say what is run: a method with its values, or a recipe, and the limits."""

from __future__ import annotations

import argparse
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
    parser.add_argument(
        "--recipe",
        metavar="FILE.toml",
        help="run these methods one after another; a limit given is for each of them",
    )
    add_limits(parser)


def chosen(args: argparse.Namespace) -> tuple[Smoother | Recipe, Stop | None]:
    """What is to be run, and its limits where it does not hold them itself."""
    from hexmend.cli.command import settings
    from hexmend.errors import ParameterError
    from hexmend.io import read_recipe
    from hexmend.parameters import from_strings
    from hexmend.smoothers import DEFAULT_METHOD, METHODS

    if args.recipe:
        if args.method or args.set:
            raise ParameterError(
                "--recipe names its methods and their values: leave out --method and --set, or change the recipe"
            )
        return read_recipe(args.recipe).limited(**given_limits(args)), None
    name = args.method or DEFAULT_METHOD
    return from_strings(METHODS[name], settings(args.set), owner=name), limits(args)
