"""The command `hexmend figures`: the pictures, plots and tables of a paper, with captions and commands."""

from __future__ import annotations

import argparse

from hexmend_app.cli.picture_command import PictureCommand

_HELP = "Write the figure set of a mesh: before and after, distributions, convergence, the table, captions, commands."


def _arguments(parser: argparse.ArgumentParser) -> None:
    from hexmend_app.cli import run_options

    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the figures")
    parser.add_argument("--format", metavar="A,B,...", help="png, pdf, svg (default png)")
    parser.add_argument("--width-mm", metavar="X", help="width of each figure in mm (default 170)")
    text = "surface, behind (the opposite side), cut, distributions, convergence or table"
    parser.add_argument("--only", metavar="PART", action="append", default=[], help=text)
    run_options.add_arguments(parser)


command = PictureCommand("figures", _HELP, _arguments, f"{__name__}.figure_files")
