"""The command `hexmend study`: the experiments of the thesis, or methods on many meshes as a recipe lists them."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_force, add_repeated
from hexmend.cli.command import action
from hexmend.errors import ParameterError

_THESIS_OPTIONS = ("--quick", "--max-seconds", "--only", "--force")
_RECIPE_OPTIONS = ("--jobs", "--scheduler", "--again", "--write-meshes")


class StudyCommand:
    """Repeat Chapter 4 and the outlooks of Section 5.2 on the gallery's meshes; or run any methods on any meshes."""

    name = "study"
    help = "Run methods with lists of values on many meshes, from a recipe; or repeat the experiments of the thesis."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        text = "the recipe of a study of meshes; thesis: the tables of Chapter 4 and outlooks of 5.2"
        parser.add_argument("study", metavar="RECIPE.toml|thesis", help=text)
        parser.add_argument("meshes", metavar="MESH", nargs="*", help="recipe: the meshes, or folders of meshes")
        text = "folder of the report (recipe: its name if not given)"
        parser.add_argument("-o", "--output", metavar="DIR", help=text)
        text = "thesis: small meshes and a few seconds per run: minutes in place of hours"
        parser.add_argument("--quick", action="store_true", help=text)
        text = "thesis: time limit of a run in seconds (default 4 hours; with --quick 5 s, and 60 s for local-sd)"
        parser.add_argument("--max-seconds", metavar="S", help=text)
        text = "thesis: a table, such as 4.1, or a section, such as 5.2.5; may be repeated"
        add_repeated(parser, "--only", "TABLE", text)
        add_force(parser)
        parser.add_argument("--jobs", metavar="N", type=int, help="recipe: tasks at a time (default: number of cores)")
        text = "recipe: run tasks on the workers of this Dask scheduler, such as tcp://host:8786"
        parser.add_argument("--scheduler", metavar="ADDRESS", help=text)
        parser.add_argument("--again", action="store_true", help="recipe: repeat tasks that are done")
        text = "recipe: write the resulting meshes into DIR/meshes"
        parser.add_argument("--write-meshes", action="store_true", help=text)

    def run(self, args: argparse.Namespace) -> int:
        _check_options(args)
        kind = "thesis" if args.study == "thesis" else "batch"
        return action(f"hexmend.cli.commands.study.{kind}_study")(args)


def _check_options(args: argparse.Namespace) -> None:
    """Raise `ParameterError` for options of the other kind of study, and for a study that is not fully named."""
    is_thesis = args.study == "thesis"
    for option in _RECIPE_OPTIONS if is_thesis else _THESIS_OPTIONS:
        if getattr(args, option.strip("-").replace("-", "_")):
            of = "a recipe's study" if is_thesis else "the thesis's"
            raise ParameterError(f"{option} is an option of {of}: leave it out")
    if is_thesis and args.meshes:
        raise ParameterError(f"{args.meshes[0]!r}: the study of the thesis generates its meshes: leave this out")
    if is_thesis and not args.output:
        raise ParameterError("the study of the thesis needs a folder for its report: add  -o DIR")
    if not is_thesis and not args.study.endswith(".toml"):
        raise ParameterError(
            f"{args.study!r} is not a study: expected a recipe, as in RECIPE.toml MESH..., or the word thesis"
        )


command = StudyCommand()
