"""Commands that draw without a window."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import NamedTuple

from hexmend.cli.command import action


class PictureCommand(NamedTuple):
    """Command that draws: its declaration, and the module whose function `run` implements it."""

    name: str
    help: str
    arguments: Callable[[argparse.ArgumentParser], None]
    module: str

    def run(self, args: argparse.Namespace) -> int:
        """Run the command and return its exit status."""
        from hexmend_app.scene.render.graphics import prepare_off_screen  # its package imports Qt's core

        prepare_off_screen()  # before Qt's widgets and VTK are imported, whose errors without OpenGL are obscure
        return action(self.module)(args)
