"""The command `hexmend study`: methods on many meshes, as a recipe lists them."""

from __future__ import annotations

import argparse

from hexmend.cli.command import CoreCommand

_HELP = "Run methods with lists of values on many meshes, from a recipe."


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("study", metavar="RECIPE.toml", help="the recipe of the study")
    parser.add_argument("meshes", metavar="MESH", nargs="*", help="the meshes, or folders of meshes")
    parser.add_argument("-o", "--output", metavar="DIR", help="folder of the report (default: the recipe's name)")
    parser.add_argument("--jobs", metavar="N", type=int, help="tasks at a time (default: number of cores)")
    text = "run tasks on the workers of this Dask scheduler, such as tcp://host:8786"
    parser.add_argument("--scheduler", metavar="ADDRESS", help=text)
    parser.add_argument("--again", action="store_true", help="repeat tasks that are done")
    parser.add_argument("--write-meshes", action="store_true", help="write the resulting meshes into DIR/meshes")


command = CoreCommand("study", _HELP, _arguments, f"{__name__}.recipe_study")
