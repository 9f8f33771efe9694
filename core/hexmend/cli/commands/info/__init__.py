"""`hexmend info`: the figures of a mesh, and what is wrong with it."""

from __future__ import annotations

import argparse
import gc

#: How many places of a trouble are told.
FIRST = 10


class Info:
    """Quality and counts of one mesh."""

    name = "info"
    help = "Print the quality and the counts of a mesh."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.arguments.files import add_mesh

        add_mesh(parser)
        parser.add_argument(
            "--doctor", action="store_true", help="say where each trouble is, and which command mends it"
        )
        parser.add_argument("--metrics", action="store_true", help="add least, mean and greatest value of every metric")
        parser.add_argument("--json", action="store_true", help="print JSON for other programs")

    def run(self, args: argparse.Namespace) -> int:
        collecting = gc.isenabled()
        gc.disable()  # most of the time goes into loading what stays to the end: it holds no garbage worth looking for
        try:
            return self._run(args)
        finally:
            if collecting:
                gc.enable()

    def _run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.arguments.files import say_notes
        from hexmend.doctor import examine
        from hexmend.io import read
        from hexmend.quality import measure, metric_statistics, summarise, summarise_second_order

        mesh = read(args.mesh, as_is=args.as_is)
        say_notes(mesh)
        figures = measure(mesh.points, mesh.hexes)
        summary = summarise(mesh, figures)
        metrics = metric_statistics(mesh, figures) if args.metrics else {}
        curved = summarise_second_order(mesh)
        if args.json:
            from hexmend.report import to_json

            answer = summary.to_dict()
            if args.metrics:
                answer["metrics"] = {name: spread.to_dict() for name, spread in metrics.items()}
            if curved is not None:
                answer["second_order"] = curved.to_dict()
            if args.doctor:
                answer["doctor"] = [finding.to_dict(FIRST) for finding in examine(mesh)]
            print(to_json(answer))
            return 0
        from hexmend.cli.output.text_tables import print_spreads, print_summaries
        from hexmend.quantity import format_count

        print_summaries(args.mesh, [""], [summary])
        if summary.locked_inverted:
            from hexmend.boundary import freed_by_sliding
            from hexmend.quality import locked

            which = locked(mesh.points, mesh.hexes, mesh.fixed, figures.inverted)
            freed = int(freed_by_sliding(mesh, which).sum())
            left = summary.locked_inverted - freed
            print(
                f"Locked: {format_count(freed)} can be freed where the boundary slides (--boundary slide), "
                f"{format_count(left)} cannot."
            )
        if curved is not None:
            print(f"Second order: {curved.words}.")
        if args.metrics:
            print_spreads(metrics)
        findings = examine(mesh, quick=not args.doctor)
        if args.doctor and not findings:
            print("The doctor finds nothing to mend; the shape of hexes is for hexmend smooth.")
        for finding in findings:
            print(f"note: {finding.message} {finding.remedy}".rstrip())
            if args.doctor and finding.places():
                print(f"      {finding.places(FIRST)}")
            if args.doctor and finding.mendable:
                print(f"      hexmend repair {args.mesh} -o OUT --only {finding.kind}")
        return 0


command = Info()
