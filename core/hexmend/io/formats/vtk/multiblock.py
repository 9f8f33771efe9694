"""VTK's XML format for data sets of several blocks, each in a file of its own (.vtm)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.format import register
from hexmend.io.base.remedies import some_names, unread_note
from hexmend.io.formats.vtk import structured, vtu
from hexmend.io.formats.vtk.grid import Grid, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.io.formats.vtk.pvtu import read_piece
from hexmend.io.formats.vtk.xml_document import Document, XMLElement
from hexmend.mesh.mesh import Mesh

_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"']vtkMultiBlockDataSet[\"']")
_READERS = {".vtu": vtu.read_grids, ".vts": structured.read_grids, ".vtr": structured.read_grids}
_READERS |= {".vti": structured.read_grids}
#: Cell data that number the blocks.
BLOCK = "block"


def read(path: Path) -> Mesh:
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
    read=read,
    matches=lambda head: _ROOT.search(head) is not None,
)
