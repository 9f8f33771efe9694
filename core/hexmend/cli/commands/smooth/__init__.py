"""The command `hexmend smooth`: smooths or untangles a mesh from file to file."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments import options
from hexmend.cli.command import CoreCommand

_HELP = "Smooth or untangle a mesh and write the result. Ctrl-C ends the run and writes the result so far."


def _arguments(parser: argparse.ArgumentParser) -> None:
    options.add_mesh(parser)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the smoothed mesh to write")
    options.add_rewrite(parser)
    options.add_method(parser)
    options.add_surface(parser)
    options.add_motion(parser)
    options.add_curves(parser)
    parser.add_argument("--only", metavar="SET", help="smooth only the hexes of this set, or 'inverted' ones")
    text = "with --only: also K rings of hexes around (default 1)"
    parser.add_argument("--rings", metavar="K", type=int, help=text)
    options.add_force(parser)
    text = "write the mesh at this interval to OUT's name with .checkpoint, removed once OUT is written"
    parser.add_argument("--checkpoint", metavar="MINUTES", type=float, help=text)
    parser.add_argument("--save-recipe", metavar="FILE.toml", help="write the methods and all values as a recipe")
    parser.add_argument("--json", metavar="FILE", help="write a report")
    parser.add_argument("--history", metavar="FILE.csv", help="write a table with a row for each iteration")


command = CoreCommand("smooth", _HELP, _arguments, f"{__name__}.smoothing")
