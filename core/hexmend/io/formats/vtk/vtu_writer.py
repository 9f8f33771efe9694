"""Writing of VTU: arrays as raw bytes at its end, compressed by zlib, or in decimals."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.formats.vtk.grid import Grid, from_mesh
from hexmend.io.formats.vtk.xml_document import TYPES
from hexmend.io.storage.binary_rows import parallel_map
from hexmend.io.storage.file_progress import advance
from hexmend.mesh.mesh import Mesh

#: Bytes of an array that are compressed together.
_BLOCK = 1 << 20
#: Level of zlib, of 9: higher ones take much longer and save little.
_LEVEL = 1
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
    """Write a VTU file of one piece.

    Raises
    ------
    FileError
        For an array of a type that VTK does not have.
    """
    appended, sections = None if encoding == "ascii" else _Appended(), list(_sections(path, grid))
    total = sum(values.nbytes for _, arrays in sections for values in arrays.values() if not isinstance(values, list))
    with open(path, "wb") as file:
        compressor = "" if encoding == "ascii" else ' compressor="vtkZLibDataCompressor"'
        root = 'VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"'
        file.write(f'<?xml version="1.0" encoding="utf-8"?>\n<{root}{compressor}>\n<UnstructuredGrid>\n'.encode())
        for section, arrays in sections:
            file.write(f"{section}\n".encode())
            for name, values in arrays.items():
                _write_array(file, name, values, appended, total)
        file.write(b"</Piece>\n</UnstructuredGrid>\n")
        if appended is not None:
            appended.write(file)
        file.write(b"</VTKFile>\n")


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
    file: BinaryIO, name: str, values: np.ndarray | list[str], appended: _Appended | None, total: int
) -> None:
    """Write an array, in decimals or later behind the XML."""
    if isinstance(values, list):
        data = b"".join(text.replace("\0", "").encode("utf-8", "replace") + b"\0" for text in values)
        head = f'<Array type="String" {array_attributes(Name=name)} NumberOfTuples="{len(values)}"'
        numbers = np.frombuffer(data, np.uint8)
    else:
        numbers = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
        head = f'<DataArray {array_attributes(numbers, Name=name)} NumberOfTuples="{len(numbers)}"'
        numbers = numbers.reshape(-1)
    file.write(head.encode("utf-8", "replace"))
    if appended is not None:
        appended.add(file, numbers)
    else:
        file.write(b' format="ascii">\n')
        for part in row_chunks(len(numbers)):
            file.write(format_rows(numbers[part]))
            advance(numbers[part].nbytes, total)
        file.write(b"\n</Array>\n" if isinstance(values, list) else b"\n</DataArray>\n")


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
