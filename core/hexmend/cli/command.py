"""The interface of a command of the command line."""

from __future__ import annotations

import argparse
import gc
import sys
from collections.abc import Callable
from importlib import import_module
from typing import NamedTuple, Protocol

from hexmend.signal_guard import uninterrupted
from hexmend.terminal_text import redraws_lines


class Command(Protocol):
    """A word of the command line, such as `smooth`.

    The core's own commands are the packages in `hexmend.cli.commands`, each with an object `command`; other
    distributions name theirs in the entry-point group `hexmend.commands`. Importing the object must be cheap, because
    `hexmend --help` imports every command: `run` imports the module that does the work (see `action`).
    """

    name: str
    help: str

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's arguments."""

    def run(self, args: argparse.Namespace) -> int:
        """Run the command and return its exit status; mistakes of the user are raised as `HexmendError`."""


@uninterrupted  # Python would lose an exception of Ctrl-C within an import
def action(module: str) -> Callable[[argparse.Namespace], int]:
    """Import a module and return its function `run`, which does the work of a command.

    On a terminal it shows the progress of the files that it reads and writes.
    """
    import_module("numpy")  # every command needs it; deep within other imports Python 3.11 takes 10 ms longer for it
    collects = gc.isenabled()
    gc.disable()  # imports take most of the time of `info`, and what they make stays to the end: nothing to collect
    try:
        run = import_module(module).run
    finally:
        if collects:  # a window collects by itself
            gc.enable()
    if "hexmend.io" in sys.modules and redraws_lines():
        return import_module("hexmend.cli.output.file_line").with_file_line(run)
    return run


class CoreCommand(NamedTuple):
    """A command of the core: its declaration, and the module whose function `run` does the work."""

    name: str
    help: str
    arguments: Callable[[argparse.ArgumentParser], None]
    module: str

    def run(self, args: argparse.Namespace) -> int:
        """Run the command and return its exit status."""
        return action(self.module)(args)
