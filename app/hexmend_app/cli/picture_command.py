"""Commands that draw without a window."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import NamedTuple

from hexmend.cli.command import action
from hexmend.signal_guard import uninterrupted


class PictureCommand(NamedTuple):
    """Command that draws: its name, help and function that adds its arguments, and the module that implements it."""

    name: str
    help: str
    add: Callable[[argparse.ArgumentParser], None]
    module: str

    @uninterrupted  # it imports modules
    def arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the arguments to a parser."""
        self.add(parser)

    def run(self, args: argparse.Namespace) -> int:
        """Run the command and return its exit status."""
        from hexmend_app.scene.render.graphics import prepare_off_screen  # its package imports Qt's core

        prepare_off_screen()  # before Qt's widgets and VTK are imported, whose errors without OpenGL are obscure
        return action(self.module)(args)
