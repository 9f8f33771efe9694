"""Meshes whose boundary slides on the surface of a file."""

from __future__ import annotations

import os

from hexmend.io.surfaces.read import read_surface
from hexmend.mesh.mesh import Mesh


def sliding_on_file(mesh: Mesh, path: str | os.PathLike[str]) -> Mesh:
    """Return the mesh with the surface of a file for its boundary to slide on; see `Mesh.sliding_on`.

    Parameters
    ----------
    mesh : Mesh
    path : path-like
        A file that `read_surface` reads.

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        If the file cannot be read as a surface.
    MeshError
        If the surface is far from the boundary.
    """
    return mesh.sliding_on(read_surface(path))


def sliding_on_boundary(mesh: Mesh) -> Mesh:
    """Return the mesh with its own boundary to slide on, as without `sliding_on_file`."""
    return mesh.sliding_on(None)
