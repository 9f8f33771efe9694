"""`hexmend smooth`: smooth or untangle a mesh from file to file."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.recipe import Recipe
    from hexmend.run import Stop
    from hexmend.smoothers import Smoother


class Smooth:
    """One method, or a recipe of several, on one mesh."""

    name = "smooth"
    help = "Smooth or untangle a mesh and write the result. Ctrl-C ends the run; what was reached is written."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.command.limits import add_limits

        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to write the smoothed mesh")
        parser.add_argument("--method", metavar="NAME", help="see `hexmend methods`")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="a parameter of the method")
        parser.add_argument(
            "--recipe",
            metavar="FILE.toml",
            help="run these methods one after another; a limit given is for each of them",
        )
        parser.add_argument("--save-recipe", metavar="FILE.toml", help="write what is run as a recipe")
        add_limits(parser)
        parser.add_argument("--json", metavar="FILE", help="write a report")
        parser.add_argument("--history", metavar="FILE.csv", help="write a row an iteration")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.advice import advise
        from hexmend.cli.command.progress import follow
        from hexmend.cli.tables import print_summaries
        from hexmend.io import read, write_recipe, writer_for
        from hexmend.report import record, write_history, write_json
        from hexmend.run import iterate

        what, stop = _chosen(args)
        write = writer_for(args.output)  # an unknown suffix is said before the work, not after
        run = iterate(read(args.mesh), what, stop)
        if args.save_recipe:
            write_recipe(args.save_recipe, run.recipe)
        follow(run)
        result = run.result()
        write(args.output, result.mesh)
        if args.json:
            write_json(args.json, record(result))
        if args.history:
            write_history(args.history, result)
        print_summaries(f"{args.mesh}: {what.title}", ["before", "after"], [result.before, result.after])
        print(f"{result.message}\nWritten to {args.output}.")
        if not result.after.inverted:
            return 0
        advice = advise(result)
        print("\n".join([advice.left, *(f"To try next: {one.text}" for one in advice.suggestions)]))
        return 4


def _chosen(args: argparse.Namespace) -> tuple[Smoother | Recipe, Stop | None]:
    """What is to be run, and its limits where it does not hold them itself."""
    from hexmend.cli.command import settings
    from hexmend.cli.command.limits import given_limits, limits
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


command = Smooth()
