"""The mesh that a command reads, and what is to be said of it."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.mesh import Mesh


def add_mesh(parser: argparse.ArgumentParser) -> None:
    """Declare the mesh file, and whether it is taken as it is."""
    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    parser.add_argument(
        "--as-is", action="store_true", help="keep parts whose hexes are all wound the other way, and do not turn them"
    )


def say_notes(mesh: Mesh) -> None:
    """Say on stderr what was done to the mesh on reading."""
    for note in mesh.notes:
        print(f"hexmend: {note}", file=sys.stderr)


def say_left_out(path: str, mesh: Mesh) -> None:
    """Warn on stderr, before anything is lost, of what a file to be written cannot hold."""
    from hexmend.io import left_out

    for what in left_out(path, mesh):
        print(f"hexmend: warning: {path} cannot hold {what}, which is left out", file=sys.stderr)
