"""Meshes of a collection: those of given folders, or of the folder that the variable HEXMEND_MESHES names."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from hexmend.errors import FileError, MeshError
from hexmend.io import read, readable_suffixes
from hexmend.io.format_lookup import format_by_place
from hexmend.io.formats.vtk.pvtu import piece_paths
from hexmend.mesh.mesh import Mesh


def mesh_files() -> list[Path]:
    """List the files with a suffix of a mesh; none without the variable."""
    folder = os.environ.get("HEXMEND_MESHES")
    return [path for path in sorted(Path(folder).iterdir()) if path.suffix in readable_suffixes()] if folder else []


def collection() -> Iterator[tuple[Path, Mesh]]:
    """Yield the files that can be read, with their meshes."""
    for path in mesh_files():
        with suppress(FileError, MeshError):
            yield path, read(path)


def find_meshes(places: Iterable[Path]) -> list[Path]:
    """List the meshes of folders and their subfolders, in the order of names, and those that are named themselves.

    Parameters
    ----------
    places : iterable of Path
        Folders, files, or folders that are one mesh, such as OpenFOAM cases.

    Returns
    -------
    list of Path
        Files with a suffix of a mesh, and folders that are a mesh; no pieces of PVTU files of the same folder.

    Raises
    ------
    FileError
        For a place that does not exist, and for a folder without meshes.
    """
    found: list[Path] = []
    for place in places:
        if not place.exists():
            raise FileError(place, "there is no such file or folder", "Choose a folder of meshes, or mesh files.")
        meshes = _without_pieces(list(_meshes_in(place))) if place.is_dir() else [place]
        if not meshes:
            raise FileError(place, "no mesh is in this folder", f"Expected files {', '.join(readable_suffixes())}.")
        found += meshes
    return list(dict.fromkeys(found))


def _meshes_in(folder: Path) -> Iterator[Path]:
    """Yield the meshes in a folder, which may itself be one."""
    if format_by_place(folder) is not None:
        yield folder
        return
    for path in sorted(folder.iterdir()):
        if path.is_dir():
            yield from () if path.name.startswith(".") else _meshes_in(path)
        elif path.suffix.lower() in readable_suffixes() and not path.name.startswith("."):
            yield path


def _without_pieces(meshes: list[Path]) -> list[Path]:
    """Leave out the files that others among them name as their pieces."""
    pieces: set[Path] = set()
    for path in meshes:
        if path.suffix.lower() == ".pvtu":
            with suppress(FileError, OSError):  # reading it tells what is wrong
                pieces.update(piece_paths(path))
    return [path for path in meshes if path not in pieces]
