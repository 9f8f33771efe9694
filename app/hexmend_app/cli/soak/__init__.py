"""The command `hexmend soak`: work for hours in one window, and check that its memory does not grow."""

from __future__ import annotations

import argparse

from hexmend.cli.command import CoreCommand

_HELP = "Open, smooth, undo, save and reopen for hours in one window, and check that its memory does not grow."


def _arguments(parser: argparse.ArgumentParser) -> None:
    text = "mesh files, used in turn (default: the bundled demo mesh)"
    parser.add_argument("mesh", metavar="MESH", nargs="*", help=text)
    text = "duration, at least four rounds (default %(default)s)"
    parser.add_argument("--minutes", metavar="N", default="60", help=text)
    parser.add_argument("--json", metavar="FILE", help="write the measurements of every round")


command = CoreCommand("soak", _HELP, _arguments, f"{__name__}.memory_check")
