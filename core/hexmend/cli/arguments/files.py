"""The mesh that a command reads, and what is to be said of it."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh


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


def check_targets(source: str, output: str, *targets: str | None) -> None:
    """Raise `FileError` before any work is done where a report cannot be written, or would replace the mesh itself.

    Parameters
    ----------
    source, output : str
        The mesh that is read, and the one to be written; they may be the same.
    targets : str or None
        Files to be written besides the mesh.
    """
    from pathlib import Path

    from hexmend.errors import FileError
    from hexmend.io.storage.atomic import check_writable

    taken: set[Path] = {Path(source).resolve(), Path(output).resolve()}
    for target in targets:
        if target is None:
            continue
        path = Path(target)
        if path.resolve() in taken:
            raise FileError(path, "is the mesh, or another file to be written", "Choose another name for it.")
        check_writable(path)
        taken.add(path.resolve())


def say_diagnosis(path: str, mesh: Mesh) -> None:
    """Say on stderr what the doctor finds in a mesh with inverted hexes: smoothing does not mend wrong numbering."""
    from hexmend.quality import measure

    if not measure(mesh.points, mesh.hexes).n_inverted:
        return
    from hexmend.doctor import examine

    for finding in examine(mesh):
        remedy = f"Run: hexmend repair {path} -o OUT --only {finding.kind}" if finding.mendable else finding.remedy
        print(f"hexmend: {finding.message} {remedy}", file=sys.stderr)
