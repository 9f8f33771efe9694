"""Paths by which meshes are listed."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.formats.openfoam import find_case


def mesh_place(path: Path) -> Path:
    """Return the path by which a mesh is listed and named: of an OpenFOAM case its folder, else its file.

    >>> mesh_place(Path("bridge.vtu")).name
    'bridge.vtu'
    """
    case = find_case(path)
    return path if case is None else case.root
