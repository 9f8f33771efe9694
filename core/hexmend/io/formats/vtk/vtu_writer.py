"""Writing of VTU: arrays as raw bytes at its end, compressed by zlib, or in decimals; it is read again to verify it."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import format_rows
from hexmend.io.formats.vtk.grid import Grid, from_mesh
from hexmend.io.formats.vtk.xml_arrays import read_values
from hexmend.io.formats.vtk.xml_document import TYPES, Document, XMLElement
from hexmend.io.storage.file_progress import advance, stage
from hexmend.io.storage.parallel_map import parallel_map
from hexmend.mesh.mesh import Mesh

#: Bytes of an array that are compressed together.
_BLOCK = 1 << 20
#: Level of zlib, of 9: higher ones take much longer and save little.
_LEVEL = 1
#: Share of the work that writing is; then the file is read again.
_WRITING_SHARE = 0.8
#: Characters kept for the attribute with the offset of an array behind the XML.
_OFFSET_WIDTH = 25
_NAMES = {code: name for name, code in TYPES.items() if name not in ("Bit", "String")}
_SPACE = "\t\n\r"
#: Replacements of characters that XML cannot contain: control characters become their pictures (U+2400...), and
#: noncharacters become U+FFFD.
_REPLACEMENTS = {code: 0x2400 + code for code in range(32) if chr(code) not in _SPACE}
_REPLACEMENTS |= {0xFFFE: 0xFFFD, 0xFFFF: 0xFFFD}
_ENTITIES = {ord(c): f"&#{ord(c)};" for c in f"&<>\"'{_SPACE}"}


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh; see `write_grid`."""
    write_grid(path, from_mesh(mesh), encoding)


def write_grid(path: Path, grid: Grid, encoding: str) -> None:
    """Write a VTU file of one piece, read it again and compare checksums.

    Raises
    ------
    FileError
        For an array of a type that VTK does not have, and where the file differs from the data.
    """
    checksums: list[tuple[str, int]] = []
    appended = None if encoding == "ascii" else _Appended()
    with open(path, "wb") as file, stage(0.0, _WRITING_SHARE):
        compressor = "" if encoding == "ascii" else ' compressor="vtkZLibDataCompressor"'
        root = 'VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"'
        file.write(f'<?xml version="1.0" encoding="utf-8"?>\n<{root}{compressor}>\n<UnstructuredGrid>\n'.encode())
        for section, arrays in _sections(path, grid):
            file.write(f"{section}\n".encode())
            for name, values in arrays.items():
                checksums.append(_write_array(file, name, values, appended))
        file.write(b"</Piece>\n</UnstructuredGrid>\n")
        if appended is not None:
            appended.write(file)
        file.write(b"</VTKFile>\n")
    with stage(_WRITING_SHARE, 1.0):
        _verify(path, checksums)


def _sections(path: Path, grid: Grid) -> Iterator[tuple[str, Mapping[str, np.ndarray | list[str]]]]:
    """Yield lines of the file, and the arrays that follow each."""
    n, m = len(grid.points), len(grid.types)
    if grid.field_data:
        yield "<FieldData>", {name: writable(path, name, values) for name, values in grid.field_data.items()}
        yield "</FieldData>", {}
    cells = {"connectivity": grid.nodes, "offsets": grid.start[1:], "types": grid.types.astype(np.uint8)}
    data = [
        {name: writable(path, name, values) for name, values in arrays.items() if np.size(values)}  # not of width 0
        for arrays in (grid.node_data, grid.cell_data)
    ]
    yield f'<Piece NumberOfPoints="{n}" NumberOfCells="{m}">\n<Points>', {"Points": grid.points}
    yield "</Points>\n<Cells>", cells
    yield "</Cells>\n<PointData>", data[0]
    yield "</PointData>\n<CellData>", data[1]
    yield "</CellData>", {}


def writable(path: Path, name: str, values: object) -> np.ndarray | list[str]:
    """Convert values to an array of a type that VTK has, or a list of strings; else raise `FileError`."""
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


def array_attributes(values: np.ndarray | None = None, **words: str) -> str:
    """Return attributes of an element: words, and the type and width of an array if one is given."""
    named = {key: word.translate(_REPLACEMENTS).translate(_ENTITIES) for key, word in words.items()}
    if values is not None:
        named = {"type": _NAMES[values.dtype.str[1:]]} | named
        named["NumberOfComponents"] = str(int(np.prod(values.shape[1:])))
    return " ".join(f'{key}="{word}"' for key, word in named.items())


class _Appended:
    """Arrays behind the XML: each is a header and blocks compressed by zlib, of `_BLOCK` bytes each but the last.

    The offsets of arrays are known once they are written; until then the XML has spaces in their places.
    """

    def __init__(self) -> None:
        self.arrays: list[tuple[int, np.ndarray]] = []  # where each one's offset is in the file, and its numbers

    def add(self, file: BinaryIO, numbers: np.ndarray) -> None:
        """Write an attribute for the offset of an array."""
        file.write(b' format="appended" ')
        self.arrays.append((file.tell(), numbers))
        file.write(b" " * _OFFSET_WIDTH + b"/>\n")

    def write(self, file: BinaryIO) -> None:
        """Write the arrays, then their offsets."""
        file.write(b'<AppendedData encoding="raw">\n_')
        begin, offsets = file.tell(), []
        total = sum(numbers.nbytes for _, numbers in self.arrays)
        for _, numbers in self.arrays:
            offsets.append(file.tell() - begin)
            _write_compressed(file, numbers, total)
        file.write(b"\n</AppendedData>\n")
        end = file.tell()
        for (place, _), offset in zip(self.arrays, offsets, strict=True):
            file.seek(place)
            file.write(f'offset="{offset}"'.encode())
        file.seek(end)


def _write_array(
    file: BinaryIO, name: str, values: np.ndarray | list[str], appended: _Appended | None
) -> tuple[str, int]:
    """Write an array, in decimals or later behind the XML; returns the name that will be read, and its checksum."""
    title = name.translate(_REPLACEMENTS)
    if isinstance(values, list):
        data = b"".join(text.replace("\0", "").encode("utf-8", "replace") + b"\0" for text in values)
        head = f'<Array type="String" Name="{title.translate(_ENTITIES)}" NumberOfTuples="{len(values)}"'
        numbers = np.frombuffer(data, np.uint8)
    else:
        numbers = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
        head = f'<DataArray {array_attributes(numbers, Name=name)} NumberOfTuples="{len(numbers)}"'
        numbers = numbers.reshape(-1)
    file.write(head.encode("utf-8", "replace"))
    if appended is not None:
        appended.add(file, numbers)
    else:
        file.write(b' format="ascii">\n' + (format_rows(numbers) if numbers.size else b""))
        file.write(b"\n</Array>\n" if isinstance(values, list) else b"\n</DataArray>\n")
    return title.encode("utf-8", "replace").decode(), zlib.crc32(numbers.view(np.uint8))


def _write_compressed(file: BinaryIO, numbers: np.ndarray, total: int) -> None:
    """Write a header and compressed blocks; the header, which has their sizes, is completed at the end.

    `total` is the size of all arrays, for the progress.
    """
    data, begin = numbers.view(np.uint8), file.tell()
    count = -(-len(data) // _BLOCK)
    sizes = np.zeros(3 + count, "<u8")  # VTK reads three words where there are no blocks too
    file.write(sizes.tobytes())
    blocks = [data[at : at + _BLOCK] for at in range(0, len(data), _BLOCK)]
    sizes[:3] = count, _BLOCK if count else 0, len(data) % _BLOCK
    for k, block in enumerate(parallel_map(lambda block: zlib.compress(block, _LEVEL), blocks)):
        sizes[3 + k] = len(block)
        file.write(block)
        advance(len(blocks[k]), total)
    end = file.tell()
    file.seek(begin)
    file.write(sizes.tobytes())
    file.seek(end)


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
