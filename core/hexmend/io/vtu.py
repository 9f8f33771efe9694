"""VTK's XML format for unstructured grids (.vtu), parsed by meshlane."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.carry import Grid, from_mesh, to_mesh
from hexmend.io.format import FORMATS, Format, Holds
from hexmend.mesh import CELL_KINDS, Mesh

log = logging.getLogger(__name__)
_DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
#: meshlane's names of the cells that it tells us of, and VTK's numbers.
_NUMBERS = {"hexahedron": 12, "voxel": 11, **{name: kind.vtk for name, kind in CELL_KINDS.items()}}


def read(path: Path) -> Mesh:
    """Read a VTU file."""
    _check_head(path)
    try:
        found = _parser().read(str(path))
    except MemoryError:
        raise
    except Exception as error:  # each of the parser's failures is another one
        _check_xml(path)
        detail = " ".join(str(error).split()) or type(error).__name__
        raise FileError(path, f"its arrays cannot be decoded ({detail[:200]})", _DAMAGED) from None
    return to_mesh(path, _grid(path, found))


def _parser():
    """meshlane's module for VTU, which logs here what it would print to the terminal."""
    from meshlane.vtu import _vtu

    _vtu.warn = _vtu.info = _say
    return _vtu


def _say(text: str, **_) -> None:
    log.info("meshlane: %s", text)


def _check_head(path: Path) -> None:
    with open(path, "rb") as file:
        head = file.read(4096)
    if b"<VTKFile" not in head:
        raise FileError(path, "does not begin with <VTKFile ...>", "Is it a VTU file? Check its suffix.")
    if b'type="UnstructuredGrid"' not in head:
        raise FileError(path, "is not of the type UnstructuredGrid", "Convert it to an unstructured grid of hexahedra.")


def _check_xml(path: Path) -> None:
    """Raise `FileError` where the file is no XML, naming the place; the parser does not."""
    from xml.etree import ElementTree as ET

    try:
        for _ in ET.iterparse(path):
            pass
    except ET.ParseError as error:
        line, column = error.position
        raise FileError(path, f"its XML is broken at line {line}, column {column}", _DAMAGED) from None


def _grid(path: Path, found) -> Grid:
    types, widths, nodes = [], [], []
    for block in found.cells:
        if block.type not in _NUMBERS:
            first, others = sum(map(len, types)), len(block.data)
            which = "the cell" if others == 1 else f"the {others} cells of that kind"
            raise FileError(
                path,
                f"cell {first} is a {block.type}; Hexmend reads hexahedra (types 11, 12)",
                f"Convert or remove {which}.",
            )
        rows = np.asarray(block.data, dtype=np.int64)
        types.append(np.full(len(rows), _NUMBERS[block.type], np.uint8))
        widths.append(np.full(len(rows), rows.shape[1], np.int64))
        nodes.append(rows.ravel())
    if not types:
        raise FileError(path, "holds no cells", "Hexmend works on hexahedral meshes only.")
    points = np.asarray(found.points, dtype=np.float64)
    data = {name: np.concatenate([np.asarray(part) for part in parts]) for name, parts in found.cell_data.items()}
    return Grid(
        points,
        np.concatenate(types),
        np.concatenate([[0], np.cumsum(np.concatenate(widths))]),
        np.concatenate(nodes),
        dict(found.point_data),
        data,
    )


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write VTU, compressed with zlib; in decimals meshlane would round to 12 digits."""
    import meshlane

    grid = from_mesh(mesh)
    kinds = {number: kind for kind, number in _NUMBERS.items()}
    cells, parts = [], []
    begin = 0
    while begin < len(grid.types):  # cells of one type follow one another
        end = begin + int(np.argmax(np.append(grid.types[begin:] != grid.types[begin], True)))
        width = int(grid.start[begin + 1] - grid.start[begin])
        cells.append(
            (kinds[int(grid.types[begin])], grid.nodes[grid.start[begin] : grid.start[end]].reshape(-1, width))
        )
        parts.append(slice(begin, end))
        begin = end
    native = {name: _native(values) for name, values in grid.cell_data.items()}
    content = meshlane.Mesh(
        grid.points,
        cells,
        point_data={name: _native(values) for name, values in grid.node_data.items()},
        cell_data={name: [values[part] for part in parts] for name, values in native.items()},
    )
    _parser().write(str(path), content, binary=True, compression="zlib")


def _native(values: np.ndarray) -> np.ndarray:
    """Values of a type that VTK has, contiguous, in the machine's byte order."""
    values = np.asarray(values)
    if values.dtype.kind == "b":
        values = values.astype(np.uint8)
    return np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("="))


HELD = frozenset(Holds) - {Holds.SIDE_SETS, Holds.FIELD_DATA}

FORMATS.add("vtu", Format("vtu", "VTU", (".vtu",), ("binary",), read, write, HELD))
