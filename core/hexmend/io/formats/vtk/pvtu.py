"""VTK's XML format for unstructured grids in several files (.pvtu), which names its pieces; read only."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path, PurePosixPath

from hexmend.errors import FileError
from hexmend.io.base.format import Format, register
from hexmend.io.formats.vtk.grid import Grid, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.io.formats.vtk.vtu import read_grids
from hexmend.io.formats.vtk.xml_document import Document
from hexmend.mesh.mesh import Mesh

_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"']PUnstructuredGrid[\"']")


def read(path: Path) -> Mesh:
    """Read a PVTU file and the files that it names, put together without their ghost cells."""
    names = _names(path)
    if len(set(names)) < len(names):
        raise FileError(path, "names a piece twice", "Write it again with the program that made it.")
    grids = [grid for name in names for grid in _piece(path, name)]
    fields = {name: values for grid in reversed(grids) for name, values in grid.field_data.items()}
    return to_mesh(path, replace(merge_grids(grids), field_data=fields))


def piece_paths(path: Path) -> list[Path]:
    """The files that a PVTU file names, there or not. Raises `FileError` where it is none, or names others' files."""
    return [_place(path, name) for name in _names(path)]


def _names(path: Path) -> list[str]:
    with Document(path, "PUnstructuredGrid") as document:
        names = [piece.get("Source") for piece in document.root.first("PUnstructuredGrid").all("Piece")]
        if not names:
            raise document.error("names no pieces")
    return names


def _piece(path: Path, name: str) -> list[Grid]:
    """The grids of a file beside another one."""
    from hexmend.io.files import check_readable

    place = _place(path, name)
    try:
        check_readable(place, "a VTU file")
        return read_grids(place)
    except FileError as error:
        raise FileError(path, f"its piece {_shown(name)}: {error.problem}", error.remedy) from None


def _shown(name: str) -> str:
    return "".join(c if c.isprintable() else "?" for c in name[:80])


def _place(path: Path, name: str) -> Path:
    """The file beside another one, or below, that a piece's name stands for."""
    relative = PurePosixPath(name.replace("\\", "/"))
    if not name or relative.is_absolute() or ".." in relative.parts or ":" in name or "\0" in name:
        raise FileError(
            path, f"names the piece {_shown(name)!r}: expected a file beside it or below", "Put its pieces there."
        )
    return path.parent / relative


register(
    Format(
        name="pvtu",
        title="PVTU",
        suffixes=(".pvtu",),
        encodings=(),
        read=read,
        matches=lambda head: _ROOT.search(head) is not None,
    )
)
