"""VTK's XML format for unstructured grids (.vtu), in every encoding, byte order and compression."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.base.format import Capability, register
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.base.remedies import unread_note
from hexmend.io.formats.vtk.grid import POLYHEDRON, Grid, to_mesh, with_polyhedra_converted
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.io.formats.vtk.vtu_writer import write
from hexmend.io.formats.vtk.xml_arrays import read_strings, read_values
from hexmend.io.formats.vtk.xml_document import Document, XMLElement, array_title
from hexmend.mesh.mesh import Mesh

_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"']UnstructuredGrid[\"']")


def read(path: Path) -> Mesh:
    """Read a VTU file and merge its pieces."""
    return to_mesh(path, merge_grids(read_grids(path)))


def read_grids(path: Path) -> list[Grid]:
    """Read the pieces of a VTU file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    list of Grid
        At least one; the first has the field data.

    Raises
    ------
    FileError
        Where the file is damaged or holds no pieces.
    """
    with Document(path, "UnstructuredGrid") as document:
        top = document.root.first("UnstructuredGrid")
        pieces = list(top.all("Piece"))
        if not pieces:
            raise document.error("holds no Piece")
        for piece in pieces:
            _charge_budget(document, piece)
        skipped: dict[str, None] = {}
        grids = [_read_grid(document, piece, skipped) for piece in pieces]
        fields: dict[str, object] = {}
        for section in (top.first("FieldData"), *(piece.first("FieldData") for piece in pieces)):
            for array in section.arrays():
                fields[array.get("Name") or f"array {len(fields)}"] = read_field(document, array)
    notes = (unread_note(f"arrays of strings, one for each node or cell ({', '.join(skipped)})"),) if skipped else ()
    return [replace(grids[0], field_data=fields, notes=notes), *grids[1:]]


def _charge_budget(document: Document, piece: XMLElement) -> None:
    """Charge the memory budget with the arrays whose lengths the attributes of the piece give."""
    for section, rows in (("Points", "NumberOfPoints"), ("PointData", "NumberOfPoints"), ("CellData", "NumberOfCells")):
        for array in piece.first(section).arrays():
            if array.get("type") != "String":
                width = _width(document, array) * document.dtype(array).itemsize
                document.budget.charge(document.count(piece, rows) * width, array_title(array))
    for array in piece.first("Cells").arrays():
        if array.get("Name") in ("offsets", "types"):
            size = document.count(piece, "NumberOfCells") * document.dtype(array).itemsize
            document.budget.charge(size, array_title(array))


def _read_grid(document: Document, piece: XMLElement, skipped: dict[str, None]) -> Grid:
    """Read a piece; names of arrays of strings are added to `skipped`."""
    points, cells = document.count(piece, "NumberOfPoints"), document.count(piece, "NumberOfCells")
    found = piece.first("Points").arrays()
    if points and not found:
        raise document.error("its Points hold no array")
    if points and _width(document, found[0]) != 3:
        raise document.error(f"its Points have {_width(document, found[0])} coordinates each: expected 3")
    points_flat = read_values(document, found[0], 3 * points) if points else np.empty(0)
    arrays = piece.first("Cells").arrays_by_name()
    for name in ("connectivity", "offsets", "types"):
        if cells and name not in arrays:
            raise document.error(f"its Cells hold no array {name!r}")
    types = ends = nodes = np.empty(0, np.int64)
    if cells:
        ends, types = (_read_integers(document, arrays[name], cells) for name in ("offsets", "types"))
    start = np.concatenate([[0], ends])
    falls = np.flatnonzero(np.diff(start) < 0)
    if falls.size:
        raise document.error(f"its offsets fall at cell {falls[0]}: expected where each cell's nodes end")
    if cells:
        document.budget.charge(int(start[-1]) * document.dtype(arrays["connectivity"]).itemsize, "connectivity")
        nodes = _read_integers(document, arrays["connectivity"], int(start[-1]))
    sections = ((piece.first("PointData"), points), (piece.first("CellData"), cells))
    data = [read_data(document, section, rows, skipped) for section, rows in sections]
    grid = Grid(points_flat.reshape(-1, 3).astype(np.float64, copy=False), types, start, nodes, *data)
    faces = _faces_of_polyhedra(document, arrays, np.asarray(types) == POLYHEDRON)
    return grid if faces is None else with_polyhedra_converted(grid, faces)


def _faces_of_polyhedra(document: Document, arrays: dict[str, XMLElement], which: np.ndarray) -> RaggedArray | None:
    """Faces of the cells `which` (c,) bool, see `with_polyhedra_converted`; None where the file does not list them."""

    def numbers(name: str) -> np.ndarray:
        return read_values(document, arrays[name]).astype(np.int64)

    if not which.any() or not ({"faces", "faceoffsets"} <= arrays.keys() or "polyhedron_offsets" in arrays):
        return None
    if "faceoffsets" in arrays:
        ends, values = numbers("faceoffsets"), numbers("faces")
    else:  # from version 2.3 on
        loops = np.split(numbers("face_connectivity"), numbers("face_offsets"))
        ends, of_cells = numbers("polyhedron_offsets"), numbers("polyhedron_to_faces")
        if len(of_cells) and not 0 <= of_cells.min() <= of_cells.max() < len(loops):
            raise document.error("its polyhedra refer to faces that it does not have")
        cells = [[loops[face] for face in part.tolist()] for part in np.split(of_cells, ends)[: len(ends)]]
        rows = [[len(cell), *(number for one in cell for number in (len(one), *one.tolist()))] for cell in cells]
        rows = [row if len(row) > 1 else [] for row in rows]  # of cells that are no polyhedra
        ends, values = np.cumsum([len(row) for row in rows]), np.array([number for row in rows for number in row])
    start = np.concatenate([[0], ends[which]])
    if len(ends) != len(which) or (np.diff(start) <= 0).any() or start[-1] > len(values):
        raise document.error("its polyhedra have no faces of their own")
    return RaggedArray(start, values[: start[-1]].astype(np.int64))


def _read_integers(document: Document, array: XMLElement, count: int) -> np.ndarray:
    """Read whole numbers of any type, (count,), signed or uint8."""
    values = read_values(document, array, count)
    if values.dtype.kind == "f" or (values.dtype == np.uint64 and values.size and values.max() > np.iinfo(int).max):
        with np.errstate(invalid="ignore"):
            wrong = np.flatnonzero((values.astype(np.int64) != values) | (np.abs(values) > 2.0**53))
        if wrong.size:
            raise document.error(f"{array_title(array)} holds {values[wrong[0]]}: expected whole numbers")
    return values if values.dtype in (np.int32, np.int64, np.uint8) else values.astype(np.int64)


def read_data(document: Document, section: XMLElement, rows: int, skipped: dict[str, None]) -> dict[str, np.ndarray]:
    """Read arrays of point or cell data of so many rows; names of arrays of strings are added to `skipped`."""
    data: dict[str, np.ndarray] = {}
    for array in section.arrays():
        name, width = array.get("Name"), _width(document, array)
        if array.get("type") == "String":
            skipped[name] = None
            continue
        values = read_values(document, array, rows * width)
        name = name if name not in data else f"{name} ({len(data) + 1})"
        data[name] = values if width == 1 else values.reshape(rows, width)
    return data


def read_field(document: Document, array: XMLElement) -> np.ndarray | list[str]:
    """Read an array of field data."""
    if array.get("type") == "String":
        return read_strings(document, array)
    width = _width(document, array)
    values = read_values(document, array)
    if array.get("type") == "Bit" and "NumberOfTuples" in array.attributes:
        values = values[: document.count(array, "NumberOfTuples") * width]
    if len(values) % width:
        raise document.error(f"{array_title(array)} has {len(values)} numbers: expected rows of {width}")
    return values if width == 1 else values.reshape(-1, width)


def _width(document: Document, array: XMLElement) -> int:
    return max(1, document.count(array, "NumberOfComponents"))  # VTK omits 1, and old versions write 0


register(
    name="vtu",
    title="VTU",
    suffixes=(".vtu",),
    encodings=("binary", "ascii"),
    read=read,
    write=write,
    capabilities=frozenset(Capability) - {Capability.SIDE_SETS, Capability.EMPTY_SETS},
    limitations=non_numeric_data,
    matches=lambda head: _ROOT.search(head) is not None,
)
