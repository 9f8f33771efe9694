"""`hexmend methods`: every method with its parameters, from their declarations."""

from __future__ import annotations

import argparse


class Methods:
    """The registry of methods."""

    name = "methods"
    help = "List the smoothing and untangling methods with their parameters."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("--json", action="store_true", help="print JSON for other programs")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.parameters import declared
        from hexmend.report import to_json
        from hexmend.smoothers import METHODS

        if args.json:
            print(to_json([smoother.to_json() for smoother in METHODS.values()]))
            return 0
        for smoother in METHODS.values():
            print(f"{smoother.name}: {smoother.title} ({smoother.source})\n    {smoother.help}")
            for one in declared(smoother):
                unit = f" {one.unit}" if one.unit else ""
                print(f"      {one.name} = {one.default}{unit}  ({one.range})  {one.help}")
            print()
        return 0


command = Methods()
