"""Output file of a command that changes a mesh: the given file with other coordinates, or a new one."""

from __future__ import annotations

import sys
from pathlib import Path

from hexmend.cli.output.mesh_messages import warn_of_losses
from hexmend.errors import FileError
from hexmend.io import Original, replaces_coordinates, write, write_as_given
from hexmend.io.coordinates.replacement import ChangedFileError, is_same_file
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
    """

    def __init__(self, path: str, source: str, mesh: Mesh, rewrite: bool):
        self.path = path
        self._original = None if rewrite else Original(Path(source), mesh)

    def warn_of_losses(self, mesh: Mesh) -> None:
        """Print a warning for each part of the mesh that is lost; none is where coordinates are replaced."""
        if not replaces_coordinates(self.path, self._original):
            warn_of_losses(self.path, mesh)

    def write(self, mesh: Mesh) -> str:
        """Write the mesh; print notes on standard error, and return a sentence about the file.

        Raises
        ------
        FileError
            Where the file cannot be written. If the given file has changed meanwhile and would be overwritten, the
            mesh is saved beside it.
        """
        expected = replaces_coordinates(self.path, self._original)
        try:
            written = write_as_given(self.path, mesh, self._original)
        except ChangedFileError as error:
            second = Path(self.path).with_stem(f"{Path(self.path).stem}-hexmend")
            write(second, mesh)
            remedy = f"The result was written anew to {second}."
            raise FileError(error.path, error.problem, remedy) from None
        for note in written.notes:
            print(f"hexmend: {note}", file=sys.stderr)
        if not written.replaced:
            if expected:
                warn_of_losses(self.path, mesh)
            return f"Written to {self.path}."
        given = self._original.path
        where = self.path if is_same_file(given, self.path) else f"a copy of {given.name}"
        kept = f"Coordinates replaced in {where}; everything else is as it was."
        return kept if is_same_file(given, self.path) else f"{kept}\nWritten to {self.path}."
