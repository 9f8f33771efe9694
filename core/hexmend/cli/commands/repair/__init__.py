"""The command `hexmend repair`: corrects numbering, unmerged blocks, duplicates and unused nodes."""

from __future__ import annotations

import argparse

from hexmend.cli.command import action


class Repair:
    """Apply the doctor's remedies to a file."""

    name = "repair"
    help = "Repair what hexmend info --doctor finds: numbering, unmerged blocks, duplicates, unused nodes."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the repaired mesh to write")
        parser.add_argument(
            "--only",
            metavar="KIND",
            action="append",
            default=[],
            help="one kind of problem; may be repeated",
        )

    def run(self, args: argparse.Namespace) -> int:
        return action("hexmend.cli.commands.repair.mesh_repair")(args)


command = Repair()
