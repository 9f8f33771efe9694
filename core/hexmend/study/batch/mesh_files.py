"""Mesh files in folders."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io import readable_suffixes
from hexmend.io.format_lookup import format_by_place
from hexmend.io.formats.vtk.pvtu import piece_paths


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
