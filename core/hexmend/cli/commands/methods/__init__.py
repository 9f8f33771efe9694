"""The command `hexmend methods`: every method with its parameters."""

from __future__ import annotations

import argparse

from hexmend.cli.command import action


class Methods:
    """List the registered methods."""

    name = "methods"
    help = "List the smoothing and untangling methods with their parameters."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("--json", action="store_true", help="print JSON for other programs")

    def run(self, args: argparse.Namespace) -> int:
        return action("hexmend.cli.commands.methods.method_list")(args)


command = Methods()
