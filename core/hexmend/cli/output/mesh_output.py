"""Output file of a command that changes a mesh: the given file with other coordinates, or a new one.

Messages about a mesh on standard error: changes on reading, problems, losses on writing.
"""

from __future__ import annotations

import shlex
import sys
from collections.abc import Iterable
from pathlib import Path

from hexmend.doctor import PROBLEMS, examine
from hexmend.errors import FileError
from hexmend.io import Original, replaces_coordinates, unsupported_data, write, write_as_given
from hexmend.io.base.remedies import unread_content
from hexmend.io.coordinates.replacement import ChangedFileError, IncludedFileError, LostContentError
from hexmend.io.files import check_not_included
from hexmend.io.format_lookup import unused_path
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
    if not (measure(mesh.points, mesh.elements).n_inverted or mesh.topology.n_nonmanifold_faces):
        return
    for finding in examine(mesh):
        remedy = f"Run: hexmend repair {path} -o OUT --only {finding.kind}" if finding.mendable else finding.remedy
        print(f"hexmend: {finding.message} {remedy}", file=sys.stderr)


def mid_node_advice(path: str, mesh: Mesh) -> str:
    """Tell what repairs hexes of second order that are invalid between sound corners; "" where there are none."""
    found = PROBLEMS["mid-nodes"].find(mesh)
    if found is None:
        return ""
    repair = f"Next: hexmend repair {shlex.quote(path)} -o OUT --only {found.kind}" if found.mendable else ""
    return f"Not fit for solving: {found.message} {found.remedy} {repair}".rstrip()


class MeshOutput:
    """Output file of a mesh.

    Parameters
    ----------
    path : str
    source : str
        File of the mesh.
    mesh : Mesh
        As read from it.
    rewrite : bool
        Write the file anew even if it has the format of `source`.
    spare : bool
        Write a result that cannot replace its own file beside it, since it may have taken long.

    Raises
    ------
    FileError
        Where `source` includes the file to write.
    """

    def __init__(self, path: str, source: str, mesh: Mesh, rewrite: bool, *, spare: bool = True):
        self.path, self._spare = path, spare
        self._source = None if rewrite else source
        self._original = None if rewrite else Original(Path(source), mesh)
        check_not_included(path, source)  # before the run, and not after it

    @property
    def replaces_coordinates(self) -> bool:
        """True if the output is to be a copy of the source with other coordinates."""
        return replaces_coordinates(self.path, self._original)

    def warn_of_losses(self, mesh: Mesh) -> None:
        """Print a warning for each part of the mesh that is lost; none is where coordinates are replaced."""
        if not self.replaces_coordinates:
            warn_of_losses(self.path, mesh, self._source)

    def write(self, mesh: Mesh) -> str:
        """Write the mesh; print notes on standard error, and return a sentence about the file.

        Raises
        ------
        FileError
            Where the file cannot be written. If the given file would be overwritten and has changed meanwhile, or
            would lose content, the mesh is saved beside it where `spare` says so.
        """
        expected = self.replaces_coordinates
        try:
            written = write_as_given(self.path, mesh, self._original)
        except (ChangedFileError, IncludedFileError, LostContentError) as error:
            if not self._spare:
                raise
            spare = unused_path(self.path)
            write(spare, mesh)
            remedy = f"The result was saved to {spare}."
            raise FileError(error.path, error.problem, remedy) from None
        for note in written.notes:
            print(f"hexmend: {note}", file=sys.stderr)
        if not written.replaced:
            if expected:
                warn_of_losses(self.path, mesh, self._source)
            return f"Written to {self.path}."
        where = self.path if written.in_place else f"a copy of {self._original.path.name}"
        kept = f"Coordinates replaced in {where}; everything else is as it was."
        return kept if written.in_place else f"{kept}\nWritten to {self.path}."
