"""The command `hexmend methods`: every method with its parameters."""

from __future__ import annotations

import argparse

from hexmend.cli.command import CoreCommand

_HELP = "List the smoothing and untangling methods with their parameters."


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print JSON for other programs")


command = CoreCommand("methods", _HELP, _arguments, f"{__name__}.method_list")
