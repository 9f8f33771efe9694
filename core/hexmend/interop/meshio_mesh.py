"""Conversion of meshes to and from meshio.

Steps that all conversions share: import of the library, and conversion of its object to a mesh.

Side sets as data of hexes, for grids that have no sets of faces.

The data of a side set "inlet" are named "sides:inlet": bit k of a hex's number (1, 2, 4, 8, 16, 32) marks its face k of
`hexmend.mesh.hexahedron.FACES`, which is also face k of VTK's hexahedron. Such data stay valid if cells are left out
or reordered.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np

from hexmend.errors import FileError, InstallationError, MeshError
from hexmend.io.base.content import from_mesh, to_mesh
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.meshio_content import content_of, meshio_fields
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation

TYPE_CHECKING = False
if TYPE_CHECKING:
    import meshio


def to_meshio(mesh: Mesh) -> meshio.Mesh:
    """Convert a mesh to meshio: hexes, cells of other kinds, data and sets.

    Node sets are point sets; element sets are cell sets. meshio has no sets of faces: bit k of the cell data
    "sides:inlet" marks face k of a cell as one of the side set "inlet". Point data "fixed" are 1 for nodes that are
    marked as fixed. Data of hexes alone are NaN or 0 for other cells. Left out are the name and the notes of the mesh
    and the order of the faces of a side set.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    meshio.Mesh
        A copy: changing it does not change the mesh.

    Raises
    ------
    InstallationError
        Where meshio is not installed.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> to_meshio(make("cube", size=27)).cells  # doctest: +SKIP
    [<meshio CellBlock, type: hexahedron, num cells: 27, tags: []>]
    """
    meshio = import_library("meshio")
    points, cells, fields = meshio_fields(replace(from_mesh(with_side_marks(mesh)), node_data=with_marks(mesh)))
    return meshio.Mesh(points, cells, **fields)


def from_meshio(meshio_mesh: meshio.Mesh, *, as_is: bool = False) -> Mesh:
    """Convert a meshio mesh with hexahedra: its hexes, cells of other kinds, data and sets.

    Arrays named as `to_meshio` names them become side sets and marks of fixed nodes again; physical groups of Gmsh
    become sets. Cells of other kinds are handled as in a file: see `hexmend.read`.

    Parameters
    ----------
    meshio_mesh : meshio.Mesh
    as_is : bool
        Keep hexes that are numbered left-handed; else they are renumbered.

    Returns
    -------
    Mesh
        A copy: changing the meshio mesh does not change it. Its `notes` list the changes.

    Raises
    ------
    InstallationError
        Where meshio is not installed.
    MeshError
        For an object that is no meshio mesh or holds no hexahedra, and for cells or points that make no mesh.
    """
    meshio = import_library("meshio")
    if not isinstance(meshio_mesh, meshio.Mesh):
        given = f"an object of type {type(meshio_mesh).__name__}"
        raise MeshError(f"from_meshio() was given {given}; expected a meshio.Mesh")
    return convert_to_mesh("meshio mesh", lambda title: to_mesh(title, content_of(meshio_mesh)), as_is)


PREFIX = "sides:"

_BITS = 1 << np.arange(len(FACES))


def with_side_marks(mesh: Mesh) -> Mesh:
    """Copy a mesh and convert its side sets to data of its hexes."""
    marks = {}
    for name, rows in mesh.side_sets.items():
        marks[PREFIX + name] = mark = np.zeros(mesh.n_hexes, np.uint8)
        np.bitwise_or.at(mark, rows[:, 0], _BITS[rows[:, 1]].astype(np.uint8))
    return mesh.replace(hex_data={**mesh.hex_data, **marks}, side_sets={})


def with_side_sets(mesh: Mesh) -> Mesh:
    """Copy a mesh and convert data from `with_side_marks` back to side sets.

    The faces of a set are in the order of the hexes. Data with the prefix that are no such marks stay data.
    """
    marks = {name: np.asarray(values) for name, values in mesh.hex_data.items() if name.startswith(PREFIX)}
    marks = {name: values for name, values in marks.items() if _are_marks(values)}
    if not marks:
        return mesh
    sides = {name.removeprefix(PREFIX): np.argwhere(v.astype(np.int64)[:, None] & _BITS) for name, v in marks.items()}

    def others(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values for name, values in data.items() if name not in marks}

    cells = tuple(replace(block, data=others(block.data)) for block in mesh.cells)
    return mesh.replace(hex_data=others(mesh.hex_data), side_sets={**mesh.side_sets, **sides}, cells=cells)


def _are_marks(values: np.ndarray) -> bool:
    return values.ndim == 1 and values.dtype.kind in "iuf" and bool(np.isin(values, np.arange(2 * _BITS[-1])).all())


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
