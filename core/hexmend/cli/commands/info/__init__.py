"""The command `hexmend info`: quality and counts of a mesh, and its problems."""

from __future__ import annotations

import argparse
import gc

from hexmend.cli.arguments.options import add_mesh
from hexmend.cli.command import action


class Info:
    """Print quality and counts of one mesh."""

    name = "info"
    help = "Print the quality and the counts of a mesh."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        add_mesh(parser)
        text = "show where each problem is, and the command that repairs it"
        parser.add_argument("--doctor", action="store_true", help=text)
        parser.add_argument("--metrics", action="store_true", help="add minimum, mean and maximum of every metric")
        text = "judge the mesh by a solver's own checks: openfoam, abaqus, ansys, lsdyna or nastran"
        parser.add_argument("--for", dest="solver", metavar="SOLVER", help=text)
        parser.add_argument("--json", action="store_true", help="print JSON for other programs")

    def run(self, args: argparse.Namespace) -> int:
        collecting = gc.isenabled()
        gc.disable()  # imports take most of the time, and what they make stays to the end: nothing to collect
        try:
            return action("hexmend.cli.commands.info.mesh_report")(args)
        finally:
            if collecting:
                gc.enable()


command = Info()
