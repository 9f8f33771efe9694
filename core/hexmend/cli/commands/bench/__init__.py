"""The command `hexmend bench`: speed and memory on this machine."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_repeated
from hexmend.cli.command import CoreCommand

_PARTS = (
    "kernels, processes, iterations, preconditioners, optima, tangled, goals, boundaries, surfaces, surface-quality, "
    "offsets, remarks, sizes, scaling, scale, files, memory, peers, start, viewer, filters, views or watching"
)


def _arguments(parser: argparse.ArgumentParser) -> None:
    add_repeated(parser, "--only", "PART", f"{_PARTS}; may be repeated")
    parser.add_argument("--json", metavar="FILE", help="write the figures")


command = CoreCommand("bench", "Measure speed and memory on this machine.", _arguments, f"{__name__}.benchmarks")
