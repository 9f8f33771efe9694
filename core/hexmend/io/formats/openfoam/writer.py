"""Writing of a case: into a case that has the mesh, as a copy of the case that was read, or a new polyMesh."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import altered_names
from hexmend.io.base.lower_order import lost_mid_nodes
from hexmend.io.base.polyhedra import LOOPS
from hexmend.io.formats.openfoam.case import SUFFIXES, CaseFiles, case_folder, find_case
from hexmend.io.formats.openfoam.foam_text import replaced_points, write_poly_mesh
from hexmend.io.formats.openfoam.reader import read
from hexmend.io.formats.openfoam.topology import patch_titles, poly_topology, zone_titles
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.temporary_files import flush_folder, make_folder, temporary_folder
from hexmend.mesh.mesh import Mesh

#: Advice where a case holds another mesh than the one to be written.
_OTHER_MESH = "Choose a new folder, or remove the constant/polyMesh of the old one."


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh into a case that has none, or replace the points of a case that has the same mesh.

    Parameters
    ----------
    path : Path
        Folder of the case, or the `.foam` file in it, which is created.
    mesh : Mesh
    encoding : str
        "ascii" or "binary".

    Raises
    ------
    FileError
        Where the case has another mesh, and where it cannot be written.
    """
    with file_errors(path):
        files = find_case(path)
        if files is not None:
            _check_same(path, files, mesh)
            replace_points(files.points, mesh.points)
        else:
            topology = poly_topology(path, mesh)
            folder = case_folder(path) / "constant"
            make_folder(folder)
            with temporary_folder(folder / "polyMesh") as temporary:
                write_poly_mesh(temporary, topology, encoding)
        create_marker(path)


def check_target(path: Path, mesh: Mesh, source: Path | None) -> None:
    """Raise `FileError` where a path cannot take a mesh.

    Parameters
    ----------
    path : Path
        As of `write`.
    mesh : Mesh
    source : Path or None
        The case that the mesh was read from, which is copied if `path` has none.
    """
    files, given = find_case(path), None if source is None else find_case(source)
    if files is None and given is not None:
        _check_new(path, case_folder(path))
    elif files is not None and (given is None or given.mesh.resolve() != files.mesh.resolve()):
        _check_same(path, files, mesh)


def limitations(mesh: Mesh) -> list[str]:
    """Describe names that are altered, and mid-nodes that are lost."""
    phrases = altered_names(patch_titles(mesh), "side sets") + altered_names(zone_titles(mesh), "sets")
    return phrases + lost_mid_nodes(mesh, frozenset(LOOPS))


def is_same(files: CaseFiles, mesh: Mesh) -> bool:
    """Return True if a mesh has the nodes and cells of a case, in its order; the corners of a cell may be reordered."""
    own = read(files.points)
    if own.n_nodes != mesh.n_nodes or own.n_hexes != mesh.n_hexes:
        return False
    return np.array_equal(np.sort(own.hexes, axis=1), np.sort(mesh.hexes, axis=1))


def _check_same(path: Path, files: CaseFiles, mesh: Mesh) -> None:
    if not is_same(files, mesh):
        raise FileError(path, f"the case in {files.root} has another mesh", _OTHER_MESH)


def _check_new(path: Path, folder: Path) -> None:
    """Raise `FileError` unless a folder is empty or does not exist."""
    if folder.is_dir() and any(entry.name != path.name for entry in folder.iterdir()):
        problem = f"the folder {folder} holds other files, but no OpenFOAM mesh"
        raise FileError(path, problem, "Choose a new folder for the copy of the case.")
    if folder.exists() and not folder.is_dir():
        raise FileError(path, f"{folder} is a file: expected a folder", "Choose a new folder.")


def replace_points(path: Path, points: np.ndarray) -> None:
    """Replace the coordinates in a file of points."""
    content = replaced_points(path, points)
    with atomic_write(path) as temporary:
        temporary.write_bytes(content)


def create_marker(path: Path) -> None:
    """Create the `.foam` file if it was named and does not exist."""
    if path.suffix.lower() in SUFFIXES and not path.exists():
        path.touch()
        flush_folder(path.absolute().parent)


@contextmanager
def file_errors(path: Path) -> Iterator[None]:
    """Context manager that turns errors of the file system into a `FileError`."""
    try:
        yield
    except OSError as error:
        where = f" ({os.fsdecode(error.filename)})" if error.filename else ""
        problem = f"cannot be written: {error.strerror or error}{where}"
        raise FileError(path, problem, "Check free space and permissions, or choose another folder.") from None
