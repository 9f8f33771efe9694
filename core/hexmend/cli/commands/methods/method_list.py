"""The list that `hexmend methods` prints."""

from __future__ import annotations

import argparse

from hexmend.cli.output.text_tables import print_parameters
from hexmend.report.records import to_json
from hexmend.smoothers import METHODS


def run(args: argparse.Namespace) -> int:
    """Print the methods as text or, with --json, as a list of objects."""
    if args.json:
        print(to_json([smoother.to_json() for smoother in METHODS.values()]))
        return 0
    for smoother in METHODS.values():
        print_parameters(smoother.name, smoother)
    return 0
