"""Slices of mesh files, VTU and VTKHDF: some of the cells and nodes, read without the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Protocol

import numpy as np

from hexmend.io.base import hdf5
from hexmend.io.format_lookup import format_of
from hexmend.io.formats.vtk.grid import Grid
from hexmend.io.formats.vtk.merge_grids import CELL_ID, NODE_ID, join_grids
from hexmend.io.formats.vtk.pvtu import piece_paths
from hexmend.io.formats.vtk.vtkhdf import VTKHDFReader, group_of
from hexmend.io.formats.vtk.vtu import read_field
from hexmend.io.formats.vtk.xml_arrays import COMPRESSORS, read_range
from hexmend.io.formats.vtk.xml_document import Document, XMLElement


@dataclass(frozen=True, eq=False, kw_only=True)
class GridSlice(Grid):
    """Some cells and some nodes of a grid, not necessarily the nodes of these cells.

    `nodes` are numbers in the whole grid, and all slices of a file have the same arrays of data.

    Parameters
    ----------
    node_ids, cell_ids : (k,) or (c,) int64
        Their numbers in the whole grid.
    """

    node_ids: np.ndarray
    cell_ids: np.ndarray


class SlicedFile(Protocol):
    """Grid in a file that can be read in slices.

    Attributes
    ----------
    n_nodes, n_cells : int
    field_data : mapping of str to object
    """

    n_nodes: int
    n_cells: int
    field_data: Mapping[str, object]

    def read(self, nodes: slice, cells: slice) -> Grid:
        """Read rows of nodes and of cells; cells have the file's numbers of nodes."""

    def ids(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the numbers of all nodes and cells of the file in a larger grid; None if it is no piece of one."""


def slice_of(files: Sequence[SlicedFile], part: int, count: int) -> GridSlice:
    """Read one of `count` parts of about the same size of the grids of some files, counted from 0."""
    sizes = {"nodes": [file.n_nodes for file in files], "cells": [file.n_cells for file in files]}
    ranges = {name: _ranges(of, part, count) for name, of in sizes.items()}
    found = []
    for k, file in enumerate(files):
        nodes, cells = ranges["nodes"][k], ranges["cells"][k]
        if nodes.stop == nodes.start and cells.stop == cells.start and (found or k + 1 < len(files)):
            continue
        grid, ids = file.read(nodes, cells), file.ids()
        node_ids, cell_ids = (np.arange(rows.start, rows.stop) for rows in (nodes, cells))
        numbers = np.asarray(grid.nodes, np.int64)
        if ids is not None:
            node_ids, cell_ids, numbers = ids[0][nodes], ids[1][cells], ids[0][numbers]
        types, start = np.asarray(grid.types).astype(np.uint8), np.asarray(grid.start, np.int64)
        cells_alone = {"types": types, "start": start, "nodes": numbers}
        found.append(GridSlice(**vars(grid) | cells_alone, node_ids=node_ids, cell_ids=cell_ids))
    if len(found) == 1:
        return found[0]
    node_ids, cell_ids = (np.concatenate([getattr(one, name) for one in found]) for name in ("node_ids", "cell_ids"))
    grid, _ = join_grids(found, [one.nodes for one in found])
    return GridSlice(**vars(grid), node_ids=node_ids, cell_ids=cell_ids)


def _ranges(sizes: Sequence[int], part: int, count: int) -> list[slice]:
    """Rows of each file that are in a part, if all rows are counted through."""
    begins = np.concatenate([[0], np.cumsum(sizes)])
    low, high = (int(begins[-1]) * which // count for which in (part, part + 1))
    bounds = np.clip(np.array([[low], [high]]) - begins[:-1], 0, sizes)
    return [slice(*own) for own in bounds.T.tolist()]


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


class VTKHDFSlices:
    """VTKHDF file that can be read in slices; see `SlicedFile`."""

    def __init__(self, path: Path):
        self._path = path
        with hdf5.open_file(path) as file:
            root = group_of(file, "VTKHDF")
            self.n_nodes, self.n_cells = (int(root[f"NumberOf{name}"][0]) for name in ("Points", "Cells"))
            self.field_data = VTKHDFReader(path, root).read_field_data()

    @classmethod
    def open(cls, path: Path) -> VTKHDFSlices | None:
        """Open a file; None if only the whole of it can be read."""
        with hdf5.open_file(path) as file:
            root = group_of(file, "VTKHDF")
            if root is None or root.attrs.get("Type") not in (b"UnstructuredGrid", "UnstructuredGrid"):
                return None
            counts = [root.get(f"NumberOf{name}") for name in ("Points", "Cells", "ConnectivityIds")]
            if "Steps" in root or any(count is None or count.shape != (1,) for count in counts):
                return None
            groups = [group_of(root, section) or {} for section in ("PointData", "CellData")]
            if any(group[name].dtype.kind not in "biuf" for group in groups for name in group):
                return None
        return cls(path)

    def read(self, nodes: slice, cells: slice) -> Grid:
        """See `SlicedFile.read`."""
        with hdf5.open_file(self._path) as file:
            reader = VTKHDFReader(self._path, group_of(file, "VTKHDF"))
            start = reader.read_rows("Offsets", slice(cells.start, cells.stop + 1)).astype(np.int64)
            ids = slice(int(start[0]), max(int(start[-1]), int(start[0])))
            points = reader.read_rows("Points", nodes).astype(np.float64, copy=False)
            types, numbers = reader.read_rows("Types", cells), reader.read_rows("Connectivity", ids)
            data = reader.read_data("PointData", nodes), reader.read_data("CellData", cells)
        return Grid(points, types, start - start[0], numbers, *data)

    def ids(self) -> None:
        """See `SlicedFile.ids`."""


__all__ = ["GridSlice", "SlicedFile", "open_slices", "slice_of"]


def open_slices(path: Path) -> Sequence[SlicedFile] | None:
    """Open a mesh file, or all its pieces, to be read in slices.

    They are VTKHDF of one part; VTU of one piece, with its arrays as raw bytes behind the XML; and PVTU of such pieces
    with `GlobalNodeId` and `GlobalElementId`, as Hexmend writes them.

    Parameters
    ----------
    path : Path

    Returns
    -------
    sequence of SlicedFile or None
        None for other files, which can be read as a whole only.

    Raises
    ------
    FileError
        Where the file cannot be read at all.
    """
    format = format_of(path)
    files: list[SlicedFile | None] = []
    if format.name == "vtkhdf":
        files = [VTKHDFSlices.open(path)]
    elif format.name == "vtu":
        files = [VTUSlices.open(path)]
    elif format.name == "pvtu":
        files = [VTUSlices.open(piece, piece=True) for piece in piece_paths(path)]
    suitable = [file for file in files if file is not None]
    return suitable if files and len(suitable) == len(files) else None
