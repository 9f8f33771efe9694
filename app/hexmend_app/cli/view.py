"""The command `hexmend [MESH]`, which opens the viewer."""

from __future__ import annotations

import argparse


class ViewCommand:
    """Command that opens the viewer."""

    name = "view"
    help = "Open the viewer; without a mesh, it opens the bundled demo mesh."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the arguments to a parser."""
        parser.add_argument("mesh", metavar="MESH", nargs="?", help="the mesh file")

    def run(self, args: argparse.Namespace) -> int:
        """Open the window, and return the exit status when it is closed."""
        from hexmend_app.shell.start.display import check_display  # its package imports PySide6

        check_display()
        from hexmend_app.shell.start.program import open_window  # Qt, which cannot be imported without a display

        return open_window(args.mesh)


command = ViewCommand()
