"""`hexmend repair`: mends what is wrong with a mesh besides its shape: numbering, merging, duplicates."""

from __future__ import annotations

import argparse


class Repair:
    """The doctor's remedies, from file to file."""

    name = "repair"
    help = "Mend what the doctor finds (hexmend info --doctor): numbering, unmerged blocks, duplicates, unused nodes."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to write the mended mesh")
        parser.add_argument(
            "--only", metavar="KIND", action="append", default=[], help="one kind of trouble; may be repeated"
        )

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.arguments.files import say_left_out, say_notes
        from hexmend.doctor import AILMENTS, examine, repair
        from hexmend.io import read, writer_for

        for name in args.only:
            AILMENTS[name]  # a name that there is not is said before the work
        write = writer_for(args.output)
        mesh = read(args.mesh, as_is=True, nodes_without_place=True)
        say_notes(mesh)
        say_left_out(args.output, mesh)
        mesh, mended = repair(mesh, args.only)
        write(args.output, mesh)
        for finding in mended:
            print(f"Mended: {finding.message} Done: {AILMENTS[finding.kind].action}.")
        left = examine(mesh)
        for finding in left:
            print(f"Left: {finding.message} {finding.remedy}".rstrip())
        if not mended and not left and not mesh.notes:
            print("Nothing is wrong with it.")
        print(f"Written to {args.output}.")
        return 0


command = Repair()
