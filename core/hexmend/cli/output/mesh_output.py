"""Output file of a command that changes a mesh: the given file with other coordinates, or a new one."""

from __future__ import annotations

import sys
from pathlib import Path

from hexmend.cli.output.mesh_messages import warn_of_losses
from hexmend.errors import FileError
from hexmend.io import Original, replaces_coordinates, write, write_as_given
from hexmend.io.coordinates.replacement import ChangedFileError, IncludedFileError, LostContentError
from hexmend.io.files import check_not_included
from hexmend.io.format_lookup import unused_path
from hexmend.mesh.mesh import Mesh


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
