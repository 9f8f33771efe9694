"""`hexmend smooth`: smooth or untangle a mesh from file to file."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.run import Run


class Smooth:
    """One method on one mesh."""

    name = "smooth"
    help = "Smooth or untangle a mesh and write the result."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.run import Stop

        limits = Stop()
        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to write the smoothed mesh")
        parser.add_argument("--method", metavar="NAME", help="see `hexmend methods`")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="a parameter of the method")
        parser.add_argument("--max-iterations", metavar="N", help=f"most iterations (default {limits.max_iterations})")
        parser.add_argument(
            "--tolerance",
            metavar="X",
            help=f"converged when no node moves further, in mean edge lengths (default {limits.tolerance:g})",
        )
        parser.add_argument("--max-seconds", metavar="S", help="most seconds in the method (default: no limit)")
        parser.add_argument("--json", metavar="FILE", help="write a report")
        parser.add_argument("--history", metavar="FILE.csv", help="write a row an iteration")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.command import settings
        from hexmend.cli.tables import print_summaries
        from hexmend.io import read, writer_for
        from hexmend.parameters import from_strings
        from hexmend.report import record, write_history, write_json
        from hexmend.run import Stop, iterate
        from hexmend.smoothers import DEFAULT_METHOD, METHODS

        name = args.method or DEFAULT_METHOD
        smoother = from_strings(METHODS[name], settings(args.set), owner=name)
        limits = {key: getattr(args, key) for key in ("max_iterations", "tolerance", "max_seconds")}
        stop = from_strings(Stop, {key: text for key, text in limits.items() if text is not None}, owner="the run")
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


def follow(run: Run) -> None:
    """Go through a run to its end, showing where it is on a terminal; Ctrl-C ends it with what was reached so far."""
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    with console.status("") as status:
        try:
            for it in run:
                if console.is_terminal:
                    status.update(
                        f"iteration {it.number}: {it.figures.n_inverted:,} inverted, q min {it.figures.q.min():.4f}, "
                        f"q mean {it.figures.q.mean():.4f}, largest move {it.largest_move:.2g}"
                    )
        except KeyboardInterrupt:
            run.close()
            print("Interrupted: what was reached so far is kept.", file=sys.stderr)


command = Smooth()
