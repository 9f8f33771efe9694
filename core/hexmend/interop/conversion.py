"""The steps that all conversions share: importing the library, and turning what was read into a mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from hexmend.errors import FileError, InstallationError, MeshError
from hexmend.interop.side_marks import with_side_sets
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation


@contextmanager
def require_library(library: str) -> Iterator[None]:
    """Raise `InstallationError`, which says how to install a library, where an import of it in the block fails."""
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name != library:
            raise
        raise InstallationError(f"{library} is not installed: pip install {library}") from None


def convert_to_mesh(title: str, read: Callable[[Path], Mesh], as_is: bool) -> Mesh:
    """Mesh of an object of another library, with its side sets and, unless `as_is`, its hexes turned the right way.

    Parameters
    ----------
    title : str
        Name of the object in messages, such as "PyVista grid".
    read : callable
        Function of the title, in the place of a file's path, that gives the mesh as the readers of files do.
    as_is : bool
        Keep parts whose hexes are all wound the other way.

    Raises
    ------
    MeshError
        Where the object holds no mesh of hexahedra.
    """
    try:
        mesh = with_side_sets(read(Path(title)))
    except FileError as error:
        raise MeshError(str(error)) from None
    return mesh if as_is else with_consistent_orientation(mesh)
