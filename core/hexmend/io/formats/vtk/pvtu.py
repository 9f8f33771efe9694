"""VTK's XML format for unstructured grids in several files (.pvtu)."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path, PurePosixPath

from hexmend.errors import FileError
from hexmend.io.base.format import Capability, register
from hexmend.io.files import check_readable
from hexmend.io.formats.vtk.grid import Grid, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids, piece_names
from hexmend.io.formats.vtk.pvtu_writer import names_not_kept, remove, write
from hexmend.io.formats.vtk.vtu import read_grids
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable

_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"']PUnstructuredGrid[\"']")


def read(path: Path) -> Mesh:
    """Read a PVTU file and merge its pieces without their ghost cells."""
    names = piece_names(path)
    if len(set(names)) < len(names):
        raise FileError(path, "lists a piece twice", "Write it again with the program that made it.")
    grids = [grid for name in names for grid in read_piece(path, name)]
    fields = {name: values for grid in reversed(grids) for name, values in grid.field_data.items()}
    return to_mesh(path, replace(merge_grids(grids, in_files=True), field_data=fields))


def piece_paths(path: Path) -> list[Path]:
    """List the files of the pieces, which may be missing.

    Raises
    ------
    FileError
        For another file, and for pieces outside the folder of the file.
    """
    return [_piece_path(path, name) for name in piece_names(path)]


def included_files(path: Path) -> set[Path]:
    """Find the files of the pieces, with links resolved; none for a file that is missing or cannot be read."""
    try:
        return {Path(os.path.realpath(piece)) for piece in piece_paths(path)}
    except (FileError, OSError):
        return set()


def read_piece(path: Path, name: str, read: Callable[[Path], list[Grid]] = read_grids) -> list[Grid]:
    """Read the grids of a piece that a file names."""
    piece = _piece_path(path, name)
    try:
        check_readable(piece, "a VTU file")
        return read(piece)
    except FileError as error:
        raise FileError(path, f"its piece {printable(name[:80])}: {error.problem}", error.remedy) from None


def _piece_path(path: Path, name: str) -> Path:
    """Path of a piece, in the folder of the file or below."""
    relative = PurePosixPath(name.replace("\\", "/"))
    if not name or relative.is_absolute() or ".." in relative.parts or ":" in name or "\0" in name:
        problem = f"refers to the piece {printable(name[:80])!r}: expected a file in its folder or below"
        raise FileError(path, problem, "Move its pieces there.")
    return path.parent / relative


register(
    name="pvtu",
    title="PVTU",
    suffixes=(".pvtu",),
    encodings=("binary", "ascii"),
    read=read,
    write=write,
    capabilities=frozenset(Capability) - {Capability.SIDE_SETS, Capability.EMPTY_SETS},
    limitations=names_not_kept,
    matches=lambda head: _ROOT.search(head) is not None,
    included=included_files,
    remove=remove,
)
