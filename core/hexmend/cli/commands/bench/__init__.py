"""The command `hexmend bench`: speed and memory on this machine."""

from __future__ import annotations

import argparse

from hexmend.cli.command import action


class Bench:
    """Measure the sections of the benchmark."""

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
        return action("hexmend.cli.commands.bench.benchmarks")(args)


command = Bench()
