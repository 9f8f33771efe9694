"""Messages about a mesh on standard error: changes on reading, problems, losses on writing."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from hexmend.doctor import examine
from hexmend.io import unsupported_data
from hexmend.io.coordinates.unread import unread_content
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure


def print_notes(mesh: Mesh, keeps_unread: bool = False) -> None:
    """Print the changes that were made to the mesh on reading.

    Parameters
    ----------
    mesh : Mesh
    keeps_unread : bool
        The output is a copy of the file, which keeps what was not read.
    """
    for note in mesh.notes:
        for content in unread_content([note]) if keeps_unread else ():
            note = f"Kept without being read: {content}."
        print(f"hexmend: {note}", file=sys.stderr)


def warn_of_losses(path: str, mesh: Mesh, source: str | None = None) -> None:
    """Print a warning for each part of the mesh that the file to be written cannot hold."""
    print_losses(path, unsupported_data(path, mesh, source))


def print_losses(path: str, parts: Iterable[str]) -> None:
    """Print a warning for each of the parts of a mesh that a file does not hold."""
    for part in parts:
        print(f"hexmend: warning: {path} cannot hold {part}, which is left out", file=sys.stderr)


def print_problems(path: str, mesh: Mesh) -> None:
    """Print what the doctor finds in a mesh with inverted or overlapping hexes: smoothing does not correct them."""
    if not (measure(mesh.points, mesh.hexes).n_inverted or mesh.topology.n_nonmanifold_faces):
        return
    for finding in examine(mesh):
        remedy = f"Run: hexmend repair {path} -o OUT --only {finding.kind}" if finding.mendable else finding.remedy
        print(f"hexmend: {finding.message} {remedy}", file=sys.stderr)
