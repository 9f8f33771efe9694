"""`hexmend bench`: speed and memory on this machine."""

from __future__ import annotations

import argparse


class Bench:
    """The benchmark."""

    name = "bench"
    help = "Measure speed and memory on this machine."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument(
            "--only",
            metavar="PART",
            action="append",
            default=[],
            help="kernels, processes, iterations, preconditioners, optima, tangled, boundaries, offsets, scaling, "
            "sizes, memory, peers, start, viewer, filters, views or watching; may be repeated",
        )
        parser.add_argument("--json", metavar="FILE", help="write the figures")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.errors import ParameterError
        from hexmend.report import write_json
        from hexmend.study.bench.sections import machine, sections

        known = sections()
        for name in args.only:
            if name not in known:
                raise ParameterError(f"--only {name!r} is unknown: expected one of {', '.join(known)}")
        report = {"machine": machine()}
        print(", ".join(f"{key} {value}" for key, value in report["machine"].items()))
        for name in args.only or known:
            section = known[name]
            print(f"\n{section.title}", flush=True)
            report[name] = section.measure()
            for line in section.lines(report[name]):
                print(f"  {line}", flush=True)
        if args.json:
            write_json(args.json, report)
        return 0


command = Bench()
