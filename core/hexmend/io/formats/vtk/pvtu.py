"""VTK's XML format for unstructured grids in several files (.pvtu).

VTK's XML format for data sets of several blocks, each in a file of its own (.vtm).
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.format import Capability, register
from hexmend.io.base.remedies import some_names, unread_note
from hexmend.io.files import check_readable
from hexmend.io.formats.vtk import structured, vtu
from hexmend.io.formats.vtk.grid import Grid, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids, piece_names
from hexmend.io.formats.vtk.pvtu_writer import names_not_kept, remove, write
from hexmend.io.formats.vtk.vtu import read_grids
from hexmend.io.formats.vtk.xml_document import Document, XMLElement
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


_VTM_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"']vtkMultiBlockDataSet[\"']")
_READERS = {".vtu": vtu.read_grids, ".vts": structured.read_grids, ".vtr": structured.read_grids}
_READERS |= {".vti": structured.read_grids}
#: Cell data that number the blocks.
BLOCK = "block"


def read_blocks(path: Path) -> Mesh:
    """Read the blocks of volumes; their number is the cell data "block", and nodes at one place are merged."""
    with Document(path, "vtkMultiBlockDataSet") as document:
        names = list(_files(document.root.first("vtkMultiBlockDataSet")))
    grids: list[Grid] = []
    others: Counter[str] = Counter()
    for name in names:
        suffix = PurePosixPath(name).suffix.lower()
        if suffix not in _READERS:
            others[f"{suffix} files"] += 1
            continue
        for grid in read_piece(path, name, _READERS[suffix]):
            number = np.full(len(grid.types), len(grids), np.int32)
            grids.append(replace(grid, cell_data={**grid.cell_data, BLOCK: number}))
    if not grids:
        kinds = f": it names {some_names(others)}" if others else ""
        raise FileError(path, f"names no grids of volumes{kinds}", "Write it with blocks of .vtu or .vts files.")
    merged = merge_grids(grids, in_files=True)
    notes = (unread_note(f"blocks that are no volumes ({some_names(others)})"),) if others else ()
    return to_mesh(path, replace(merged, notes=(*merged.notes, *notes)))


def _files(element: XMLElement) -> Iterator[str]:
    """Names of the files of a block and the blocks in it."""
    for child in element.children:
        if child.name == "DataSet" and child.get("file"):
            yield child.get("file")
        elif child.name in ("Block", "Piece"):
            yield from _files(child)


register(
    name="vtm",
    title="VTK multi-block",
    suffixes=(".vtm",),
    encodings=(),
    read=read_blocks,
    matches=lambda head: _VTM_ROOT.search(head) is not None,
)
