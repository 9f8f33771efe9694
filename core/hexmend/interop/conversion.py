"""Steps that all conversions share: import of the library, and conversion of its object to a mesh."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType

from hexmend.errors import FileError, InstallationError, MeshError
from hexmend.interop.side_marks import with_side_sets
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation


def import_library(library: str) -> ModuleType:
    """Import a library; raise `InstallationError` where it is not installed."""
    try:
        return import_module(library)
    except ModuleNotFoundError as error:
        if error.name != library:
            raise
        raise InstallationError(f"{library} is not installed: pip install {library}") from None


def convert_to_mesh(title: str, read: Callable[[Path], Mesh], as_is: bool) -> Mesh:
    """Convert an object of another library to a mesh with side sets, and renumber left-handed hexes unless `as_is`.

    Parameters
    ----------
    title : str
        Name of the object in messages, such as "PyVista grid".
    read : callable
        read(title) returns the mesh; it takes the title in place of a file's path, as readers of files do.
    as_is : bool
        Keep hexes that are numbered left-handed.

    Returns
    -------
    Mesh

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
