"""The command `hexmend compare`: several methods on one mesh, as a table like those of the thesis."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_settings
from hexmend.cli.command import action


class Compare:
    """Run methods on a mesh and tabulate their results."""

    name = "compare"
    help = "Run several methods on a mesh and write a table of the results as CSV, Markdown, LaTeX and JSON."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the tables")
        parser.add_argument(
            "--methods",
            metavar="A,B,...",
            help="see `hexmend methods` (default: all of them); a FILE.toml is a recipe",
        )
        add_settings(parser)
        parser.add_argument("--write-meshes", action="store_true", help="write each method's mesh into the folder too")

    def run(self, args: argparse.Namespace) -> int:
        return action("hexmend.cli.commands.compare.method_table")(args)


command = Compare()
