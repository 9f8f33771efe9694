"""Writing of a case: into a case that has the mesh, as a copy of the case that was read, or a new polyMesh.

Coordinates of a case, which are replaced in the case itself, in one with the same mesh, or in a copy without results.
"""

from __future__ import annotations

import os
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import altered_names
from hexmend.io.base.lower_order import lost_mid_nodes
from hexmend.io.base.polyhedra import LOOPS
from hexmend.io.formats.openfoam.case import SUFFIXES, CaseFiles, case_folder, find_case, is_time
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.foam_text import replaced_points, write_poly_mesh
from hexmend.io.formats.openfoam.lists import read_vectors
from hexmend.io.formats.openfoam.reader import read
from hexmend.io.formats.openfoam.topology import patch_titles, poly_topology, zone_titles
from hexmend.io.storage.atomic import AtomicFiles, atomic_write
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


@dataclass(frozen=True, eq=False)
class CaseCoordinates:
    """Points of a case; see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : CaseFiles
    points : (n, 3) float64
    """

    files: CaseFiles
    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Replace the points of the case that the target names, or copy the case to a new folder with other points.

        Returns a sentence on results that are not copied, and on coordinates that are rounded.
        """
        known, notes = find_case(target), ()
        with file_errors(target):
            if known is not None:
                replace_points(known.points, points)
            else:
                content, root = replaced_points(self.files.part("points"), points), case_folder(target)
                make_folder(root.parent)
                left = results(self.files.root)
                with temporary_folder(root) as temporary:
                    _copy_folder(self.files.root, temporary, self.files, set(left), content)
                    if target.is_file():  # the .foam file, alone in the folder, which has to be empty now
                        os.replace(target, temporary / target.name)
                named = ", ".join([*left[:4], *(["..."] if len(left) > 4 else [])])
                notes = (f"The results of the case ({named}) are not copied.",) if left else ()
            create_marker(target)
        scalar = FoamFile(find_case(target).points).arch.scalar
        rounded = scalar.itemsize == 4 and FoamFile(find_case(target).points).is_binary
        return (*notes, *(["The case has coordinates of 32 bits: they are rounded."] if rounded else []))


def locate(path: Path) -> CaseCoordinates:
    """Find the points of a case; raises `FileError` where they cannot be read."""
    files = find_case(path)
    if files is None:
        raise FileError(path, "there is no OpenFOAM case", "Choose the folder of a case.")
    return CaseCoordinates(files, read_vectors(FoamFile(files.points), "points"))


#: Folders of results beside those of times.
_RESULTS = ("postProcessing", "VTK")


def results(root: Path) -> list[str]:
    """List the names in the folder of a case that are not copied: results of times but 0, and of processors."""

    def is_result(entry: Path) -> bool:
        later = is_time(entry.name) and float(entry.name) != 0
        return entry.is_dir() and (later or entry.name.startswith("processor") or entry.name in _RESULTS)

    return sorted(entry.name for entry in root.iterdir() if is_result(entry))


def _copy_folder(source: Path, target: Path, files: CaseFiles, omitted: set[str], points: bytes) -> None:
    own = files.part("points")
    for entry in sorted(source.iterdir()):
        new = target / entry.name
        if entry.name in omitted or entry.name.startswith(".hexmend-"):
            continue
        if entry == own:
            new.write_bytes(points)
        elif entry.is_dir() and not _is_link_inside(entry, files):
            new.mkdir()
            _copy_folder(entry, new, files, set(), points)
        elif entry.is_symlink() and (entry.is_dir() or not entry.exists()):
            os.symlink(os.readlink(entry), new)
        elif entry.is_file():  # no pipes and sockets
            shutil.copy2(entry, new)
            new.chmod(stat.S_IMODE(new.stat().st_mode) | stat.S_IWUSR)


def _is_link_inside(entry: Path, files: CaseFiles) -> bool:
    """Return True for a link to a folder of the case itself, unless it leads to the points."""
    if not entry.is_symlink() or files.mesh.is_relative_to(entry):
        return False
    return entry.resolve().is_relative_to(files.root.resolve())
