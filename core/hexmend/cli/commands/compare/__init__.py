"""The command `hexmend compare`: a table of several methods on one mesh."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_motion, add_settings, add_surface
from hexmend.cli.command import CoreCommand

_HELP = "Run several methods on a mesh and write a table of the results as CSV, Markdown, LaTeX and JSON."


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the tables")
    text = "see `hexmend methods` (default: all of them); a FILE.toml or a name such as gentle is a recipe"
    parser.add_argument("--methods", metavar="A,B,...", help=text)
    add_settings(parser)
    add_surface(parser)
    add_motion(parser)
    parser.add_argument("--write-meshes", action="store_true", help="write each method's mesh into the folder too")


command = CoreCommand("compare", _HELP, _arguments, f"{__name__}.method_table")
