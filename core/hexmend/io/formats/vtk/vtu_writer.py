"""Writing of VTU: arrays in base64, compressed by zlib, or in decimals; the file is read again to verify it."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import format_rows
from hexmend.io.formats.vtk.grid import Grid, from_mesh
from hexmend.io.formats.vtk.xml_arrays import read_values
from hexmend.io.formats.vtk.xml_document import TYPES, Document, XMLElement
from hexmend.mesh.mesh import Mesh

#: Bytes of an array that are compressed together.
_BLOCK = 1 << 20
_NAMES = {code: name for name, code in TYPES.items() if name not in ("Bit", "String")}
_SPACE = "\t\n\r"
#: Replacements of characters that XML cannot contain: control characters become their pictures (U+2400...), and
#: noncharacters become U+FFFD.
_REPLACEMENTS = {code: 0x2400 + code for code in range(32) if chr(code) not in _SPACE}
_REPLACEMENTS |= {0xFFFE: 0xFFFD, 0xFFFF: 0xFFFD}
_ENTITIES = {ord(c): f"&#{ord(c)};" for c in f"&<>\"'{_SPACE}"}


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a VTU file, read it again and compare checksums.

    Raises
    ------
    FileError
        For an array of a type that VTK does not have, and where the file differs from the data.
    """
    grid = from_mesh(mesh)
    checksums: list[tuple[str, int]] = []
    with open(path, "wb") as file:
        compressor = "" if encoding == "ascii" else ' compressor="vtkZLibDataCompressor"'
        root = 'VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32"'
        file.write(f'<?xml version="1.0" encoding="utf-8"?>\n<{root}{compressor}>\n<UnstructuredGrid>\n'.encode())
        for section, arrays in _sections(path, grid):
            file.write(f"{section}\n".encode())
            for name, values in arrays.items():
                checksums.append(_write_array(file, name, values, encoding == "ascii"))
        file.write(b"</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
    _verify(path, checksums)


def _sections(path: Path, grid: Grid) -> Iterator[tuple[str, Mapping[str, np.ndarray | list[str]]]]:
    """Yield lines of the file, and the arrays that follow each."""
    n, m = len(grid.points), len(grid.types)
    if grid.field_data:
        yield "<FieldData>", {name: _writable(path, name, values) for name, values in grid.field_data.items()}
        yield "</FieldData>", {}
    cells = {"connectivity": grid.nodes, "offsets": grid.start[1:], "types": grid.types.astype(np.uint8)}
    data = [
        {name: _writable(path, name, values) for name, values in arrays.items() if np.size(values)}  # not of width 0
        for arrays in (grid.node_data, grid.cell_data)
    ]
    yield f'<Piece NumberOfPoints="{n}" NumberOfCells="{m}">\n<Points>', {"Points": grid.points}
    yield "</Points>\n<Cells>", cells
    yield "</Cells>\n<PointData>", data[0]
    yield "</PointData>\n<CellData>", data[1]
    yield "</CellData>", {}


def _writable(path: Path, name: str, values: object) -> np.ndarray | list[str]:
    """Convert values to an array of a type that VTK has, or a list of strings."""
    if isinstance(values, str):
        return [values]
    if isinstance(values, (list, tuple)) and all(isinstance(text, str) for text in values):
        return list(values)
    array = np.asarray(values)
    if array.dtype.kind == "U":
        return [str(text) for text in array.ravel()]
    if array.dtype.kind == "b":
        array = array.astype(np.uint8)
    if array.dtype.str[1:] not in _NAMES:
        raise FileError(path, f"the array {name!r} holds {array.dtype}, which VTK cannot", "Remove the array.")
    return np.atleast_1d(array)


def _write_array(file: BinaryIO, name: str, values: np.ndarray | list[str], ascii: bool) -> tuple[str, int]:
    """Write an array; returns the name that will be read, and the checksum of its bytes."""
    title = name.translate(_REPLACEMENTS)
    if isinstance(values, list):
        data = b"".join(text.replace("\0", "").encode("utf-8", "replace") + b"\0" for text in values)
        head = f'<Array type="String" Name="{title.translate(_ENTITIES)}" NumberOfTuples="{len(values)}"'
        numbers = np.frombuffer(data, np.uint8)
    else:
        numbers = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
        rows, width = len(numbers), int(np.prod(numbers.shape[1:]))
        head = f'<DataArray type="{_NAMES[numbers.dtype.str[1:]]}" Name="{title.translate(_ENTITIES)}"'
        head += f' NumberOfComponents="{width}" NumberOfTuples="{rows}"'
        numbers = numbers.reshape(-1)
    file.write(f'{head} format="{"ascii" if ascii else "binary"}">\n'.encode("utf-8", "replace"))
    if ascii:
        file.write(format_rows(numbers))
    else:
        _write_compressed(file, numbers)
    file.write(b"\n</Array>\n" if isinstance(values, list) else b"\n</DataArray>\n")
    return title.encode("utf-8", "replace").decode(), zlib.crc32(numbers.view(np.uint8))


def _write_compressed(file: BinaryIO, numbers: np.ndarray) -> None:
    """Write blocks compressed by zlib, of `_BLOCK` bytes each except the last one."""
    data = numbers.view(np.uint8)
    blocks = [zlib.compress(data[at : at + _BLOCK], 4) for at in range(0, len(data), _BLOCK)]
    sizes = [len(blocks), _BLOCK, len(data) % _BLOCK, *map(len, blocks)] if blocks else [0]
    file.write(b64encode(np.array(sizes, "<u4").tobytes()))
    file.write(b64encode(b"".join(blocks)))


def _verify(path: Path, checksums: list[tuple[str, int]]) -> None:
    """Raise `FileError` unless the file holds arrays with these names and checksums, in this order."""
    with Document(path, "UnstructuredGrid") as document:
        arrays = list(_arrays(document.root))
        found = [(array.get("Name"), zlib.crc32(_as_written(document, array))) for array in arrays]
    wrong = next((k for k, (a, b) in enumerate(zip(checksums, found, strict=False)) if a != b), None)
    if wrong is not None or len(checksums) != len(found):
        name = repr(checksums[wrong][0]) if wrong is not None else "one"
        problem = f"the array {name} is not read again as it was written"
        raise FileError(path, problem, "Write another format, or another place.")


def _as_written(document: Document, array: XMLElement) -> np.ndarray:
    values = read_values(document, array)
    dtype = np.uint8 if array.get("type") == "String" else document.dtype(array)
    return np.ascontiguousarray(values.astype(dtype, copy=False)).view(np.uint8)


def _arrays(element: XMLElement) -> Iterator[XMLElement]:
    """Yield all arrays in the order of the file."""
    for child in element.children:
        yield from [child] if child.name in ("DataArray", "Array") else _arrays(child)
