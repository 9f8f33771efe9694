"""Conversion of meshes to and from meshio."""

from __future__ import annotations

from dataclasses import replace

from hexmend.errors import MeshError
from hexmend.interop.conversion import convert_to_mesh, import_library, with_side_marks
from hexmend.io.base.content import from_mesh, to_mesh
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.meshio_content import content_of, meshio_fields
from hexmend.mesh.mesh import Mesh

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
