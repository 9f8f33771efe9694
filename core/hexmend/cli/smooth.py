"""`hexmend smooth`: smooth or untangle a mesh from file to file."""

from __future__ import annotations

import argparse


class Smooth:
    """One method on one mesh."""

    name = "smooth"
    help = "Smooth or untangle a mesh and write the result. Ctrl-C ends the run; what was reached is written."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.command.limits import add_limits

        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to write the smoothed mesh")
        parser.add_argument("--method", metavar="NAME", help="see `hexmend methods`")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="a parameter of the method")
        add_limits(parser)
        parser.add_argument("--json", metavar="FILE", help="write a report")
        parser.add_argument("--history", metavar="FILE.csv", help="write a row an iteration")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.command import settings
        from hexmend.cli.command.limits import limits
        from hexmend.cli.command.progress import follow
        from hexmend.cli.tables import print_summaries
        from hexmend.io import read, writer_for
        from hexmend.parameters import from_strings
        from hexmend.report import record, write_history, write_json
        from hexmend.run import iterate
        from hexmend.smoothers import DEFAULT_METHOD, METHODS

        name = args.method or DEFAULT_METHOD
        smoother = from_strings(METHODS[name], settings(args.set), owner=name)
        stop = limits(args)
        write = writer_for(args.output)  # an unknown suffix is said before the work, not after
        run = iterate(read(args.mesh), smoother, stop)
        follow(run)
        result = run.result()
        write(args.output, result.mesh)
        if args.json:
            write_json(args.json, record(result))
        if args.history:
            write_history(args.history, result)
        print_summaries(f"{args.mesh}: {smoother.title}", ["before", "after"], [result.before, result.after])
        print(f"{result.message}\nWritten to {args.output}.")
        return 4 if result.after.inverted else 0


command = Smooth()
