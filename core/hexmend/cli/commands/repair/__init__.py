"""The command `hexmend repair`: corrects numbering, unmerged blocks, duplicates and unused nodes."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_repeated, add_rewrite
from hexmend.cli.command import CoreCommand

_HELP = "Repair what hexmend info --doctor finds: numbering, unmerged blocks, duplicates, unused nodes."


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the repaired mesh to write")
    add_rewrite(parser)
    add_repeated(parser, "--only", "KIND", "one kind of problem; may be repeated")


command = CoreCommand("repair", _HELP, _arguments, f"{__name__}.mesh_repair")
