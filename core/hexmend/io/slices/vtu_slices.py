"""VTU files of one piece whose arrays are raw bytes behind the XML, read in slices."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

import numpy as np

from hexmend.io.formats.vtk.grid import Grid
from hexmend.io.formats.vtk.merge_grids import CELL_ID, NODE_ID
from hexmend.io.formats.vtk.vtu import read_field
from hexmend.io.formats.vtk.xml_arrays import COMPRESSORS, read_range
from hexmend.io.formats.vtk.xml_document import Document, XMLElement


class VTUSlices:
    """VTU file that can be read in slices; see `SlicedFile`.

    Parameters
    ----------
    path : Path
    piece : bool
        It is a piece of a larger grid, whose nodes and cells have numbers there.
    """

    def __init__(self, path: Path, piece: bool = False):
        self._path, self._is_piece = path, piece
        with Document(path, "UnstructuredGrid") as document:
            top = document.root.first("UnstructuredGrid")
            (self._piece,) = top.all("Piece")
            self.n_nodes = document.count(self._piece, "NumberOfPoints")
            self.n_cells = document.count(self._piece, "NumberOfCells")
            fields = [*top.first("FieldData").arrays(), *self._piece.first("FieldData").arrays()]
            self.field_data = {array.get("Name"): read_field(document, array) for array in fields}

    @classmethod
    def open(cls, path: Path, piece: bool = False) -> VTUSlices | None:
        """Open a file; None if only the whole of it can be read."""
        with Document(path, "UnstructuredGrid") as document:
            pieces = list(document.root.first("UnstructuredGrid").all("Piece"))
            sections = (
                [pieces[0].first(name) for name in ("Points", "Cells", "PointData", "CellData")] if pieces else []
            )
            arrays = [array for section in sections for array in section.arrays()]
            names = {array.get("Name") for array in arrays}
            packed = document.root.get("compressor")
            places = list(sections[0].arrays()) if sections else []
            suitable = len(pieces) == 1 and {"connectivity", "offsets", "types"} <= names
            suitable = suitable and [document.count(array, "NumberOfComponents") for array in places] == [3]
            suitable = suitable and all(
                array.get("format") == "appended" and array.get("type") not in ("String", "Bit") for array in arrays
            )
            if not suitable or (packed and packed not in COMPRESSORS) or document.appended()[1] != "raw":
                return None
            if piece and not {NODE_ID, CELL_ID} <= names:
                return None
        return cls(path, piece)

    def read(self, nodes: slice, cells: slice) -> Grid:
        """See `SlicedFile.read`."""
        with Document(self._path, "UnstructuredGrid") as document:
            arrays = self._piece.first("Cells").arrays_by_name()
            types = read_range(document, arrays["types"], cells.start, cells.stop)
            first = max(cells.start - 1, 0)
            ends = read_range(document, arrays["offsets"], first, cells.stop).astype(np.int64)
            ends = ends if cells.start else np.concatenate([[0], ends])
            begin, end = int(ends[0]), int(ends[-1])
            numbers = read_range(document, arrays["connectivity"], begin, end)
            (places,) = self._piece.first("Points").arrays()[:1]
            points = self._rows(document, places, nodes).reshape(-1, 3).astype(np.float64, copy=False)
            data = [self._data(document, "PointData", nodes), self._data(document, "CellData", cells)]
        return Grid(points, types, ends - begin, numbers, *data)

    def ids(self) -> tuple[np.ndarray, np.ndarray] | None:
        """See `SlicedFile.ids`."""
        return self._ids if self._is_piece else None

    @cached_property
    def _ids(self) -> tuple[np.ndarray, np.ndarray]:
        with Document(self._path, "UnstructuredGrid") as document:
            nodes, cells = (self._piece.first(name).arrays_by_name() for name in ("PointData", "CellData"))
            node_ids = read_range(document, nodes[NODE_ID], 0, self.n_nodes)
            cell_ids = read_range(document, cells[CELL_ID], 0, self.n_cells)
        return node_ids.astype(np.int64), cell_ids.astype(np.int64)

    def _data(self, document: Document, section: str, rows: slice) -> dict[str, np.ndarray]:
        arrays, own = self._piece.first(section).arrays_by_name(), (NODE_ID, CELL_ID) if self._is_piece else ()
        return {name: self._rows(document, array, rows) for name, array in arrays.items() if name not in own}

    def _rows(self, document: Document, array: XMLElement, rows: slice) -> np.ndarray:
        width = max(1, document.count(array, "NumberOfComponents"))
        values = read_range(document, array, rows.start * width, rows.stop * width)
        return values if width == 1 else values.reshape(-1, width)
