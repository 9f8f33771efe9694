"""`hexmend [MESH]`: the viewer."""

from __future__ import annotations

import argparse


class ViewCommand:
    """Opens the window."""

    name = "view"
    help = "Open the viewer; the bundled demo mesh where no mesh is named."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", nargs="?", help="the mesh file")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend_app.shell.display import check_display

        check_display()
        from hexmend_app.shell.program import open_window

        return open_window(args.mesh)


command = ViewCommand()
