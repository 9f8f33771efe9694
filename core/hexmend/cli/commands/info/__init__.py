"""The command `hexmend info`: quality and counts of a mesh, and its problems."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_mesh
from hexmend.cli.command import CoreCommand

_HELP = "Print the quality and the counts of a mesh."


def _arguments(parser: argparse.ArgumentParser) -> None:
    add_mesh(parser)
    text = "show where each problem is, and the command that repairs it"
    parser.add_argument("--doctor", action="store_true", help=text)
    parser.add_argument("--metrics", action="store_true", help="add minimum, mean and maximum of every metric")
    text = "judge the mesh by a solver's own checks: openfoam, abaqus, ansys, lsdyna or nastran"
    parser.add_argument("--for", dest="solver", metavar="SOLVER", help=text)
    parser.add_argument("--json", action="store_true", help="print JSON for other programs")


command = CoreCommand("info", _HELP, _arguments, f"{__name__}.mesh_report")
