"""Arrays of VTK's legacy format: numbers in decimals or big-endian bytes, strings, and lists of cells.

Writing of the format, version 3.0.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO
from urllib.parse import quote, unquote

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.numbering import runs
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.formats.vtk.grid import from_mesh
from hexmend.io.storage.binary_rows import native
from hexmend.io.storage.file_progress import advance
from hexmend.mesh.mesh import Mesh

#: NumPy types of VTK's types, without the byte order.
TYPES = {
    "bit": "u1", "char": "i1", "signed_char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2",
    "int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8",
    "vtktypeuint64": "u8", "vtkidtype": "i4", "float": "f4", "double": "f8",
}  # fmt: skip
#: VTK's types of texts.
STRINGS = ("string", "utf8_string")


def read_array(cursor: ByteCursor, section: str, rows: int, width: int, kind: str) -> np.ndarray:
    """Read numbers of a VTK type.

    Parameters
    ----------
    cursor : ByteCursor
    section : str
        Name in error messages.
    rows, width : int
    kind : str
        VTK's name of the type.

    Returns
    -------
    (rows, width) array
        In the machine's byte order; real numbers of text files are float64.

    Raises
    ------
    FileError
        For an unknown type, missing numbers, and numbers outside the range of the type.
    """
    code = TYPES.get(kind.lower())
    if code is None:
        raise cursor.error(f"{section} has the type {quoted(kind)}: expected {', '.join(TYPES)}")
    if cursor.is_text:
        wide = np.float64 if code[0] == "f" else np.uint64 if code == "u8" else np.int64
        values = cursor.read_numbers(section, rows, width, wide)
        if code[0] == "f":
            return values
        limit = np.iinfo(code)
        if values.size and (values.min() < limit.min or values.max() > limit.max):
            row, column = np.argwhere((values < limit.min) | (values > limit.max))[0]
            problem = f"{section} holds {values[row, column]} in row {row + 1} of {rows}"
            raise cursor.error(f"{problem}, which its type {kind} cannot")
        return values.astype(code)
    if kind.lower() == "bit":
        bits = np.unpackbits(np.frombuffer(cursor.read_bytes((rows * width + 7) // 8, section), np.uint8))
        return bits[: rows * width].reshape(rows, width)
    return native(cursor.read_binary(section, rows, width, f">{code}"))


def read_integers(cursor: ByteCursor, section: str, rows: int, kind: str) -> np.ndarray:
    """Read whole numbers of a VTK type, (rows,) int32 where they fit and the file is binary; see `read_array`."""
    if TYPES.get(kind.lower(), "i8")[0] == "f":
        raise cursor.error(f"{section} has the type {kind}: expected whole numbers")
    code = TYPES.get(kind.lower())
    if code is not None and not cursor.is_text and kind.lower() != "bit":
        return cursor.read_integers(section, rows, 1, f">{code}")[:, 0]
    return read_array(cursor, section, rows, 1, kind)[:, 0]


def read_strings(cursor: ByteCursor, count: int) -> list[str]:
    """Read strings: one a line in text files, each after its length in binary files."""
    if count > len(cursor.data) - cursor.pos:
        raise cursor.error(f"{count} strings are declared before {cursor.location}: the file ends before")
    if cursor.is_text:
        return [unquote(cursor.rest_of_line()) for _ in range(count)]
    strings = []
    for _ in range(count):
        # The first two bits of the length tell its size in bytes: 11 one, 10 two, 01 four, 00 eight.
        size = 8 >> cursor.read_bytes(1, "a string")[0] // 64
        cursor.pos -= 1
        length = int.from_bytes(cursor.read_bytes(size, "a string"), "big") & ((1 << 8 * size - 2) - 1)
        strings.append(cursor.read_bytes(length, "a string").decode("utf-8", errors="replace"))
    return strings


def split_cells(cursor: ByteCursor, flat: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Split the numbers of a section CELLS, in which each cell is its number of nodes and these.

    Parameters
    ----------
    cursor : ByteCursor
        Raises the errors.
    flat : (k,) int32 or int64
    count : int
        Number of cells.

    Returns
    -------
    start : (count + 1,) int64
        Cell i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int
        Of the type of `flat`.

    Raises
    ------
    FileError
        Where the numbers do not make `count` cells.
    """
    if len(flat) == 9 * count and (flat[::9] == 8).all():
        return 8 * np.arange(count + 1), np.ascontiguousarray(flat.reshape(-1, 9)[:, 1:]).ravel()
    cells, whole = RaggedArray.of_counted_rows(flat)
    if len(cells) > count:
        raise cursor.error(f"CELLS holds {len(flat)} numbers: its {count} cells need {cells.start[count] + count}")
    if len(cells) < count or not whole:
        raise cursor.error(f"CELLS ends in cell {len(cells) - (not whole)} of the {count} that CELL_TYPES names")
    return cells.start, cells.values


#: VTK's name of each NumPy type, the first of several.
NAMES = {code: name for name, code in reversed(TYPES.items()) if name != "bit"}


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 3.0, which all programs read."""
    grid = from_mesh(mesh)
    ascii = encoding == "ascii"
    with open(path, "wb") as file:
        name = mesh.name.replace("\n", " ")[:200] or "mesh"
        head = f"# vtk DataFile Version 3.0\n{name}\n{encoding.upper()}\nDATASET UNSTRUCTURED_GRID\n"
        file.write(head.encode("utf-8", "replace"))
        data = (*grid.node_data.values(), *grid.cell_data.values())
        total = (
            grid.points.nbytes + 4 * grid.nodes.size + 5 * grid.types.size + sum(np.asarray(one).nbytes for one in data)
        )
        _write_arrays(path, file, grid.field_data, ascii, total)
        file.write(f"POINTS {len(grid.points)} double\n".encode())
        _write_numbers(file, grid.points, "f8", ascii, total)
        widths = np.diff(grid.start)
        count = len(widths)
        file.write(f"CELLS {count} {count + len(grid.nodes)}\n".encode())
        flat = np.empty(count + len(grid.nodes), np.int32)
        begins = grid.start[:-1] + np.arange(count)
        is_node = np.ones(len(flat), dtype=bool)
        is_node[begins] = False
        flat[begins], flat[is_node] = widths, grid.nodes
        if ascii:
            for run in runs(widths):
                width = widths[run.start] + 1
                rows = flat[begins[run.start] :][: (run.stop - run.start) * width].reshape(-1, width)
                _write_numbers(file, rows, "i4", ascii, total)
        else:
            _write_numbers(file, flat, "i4", ascii, total)
        file.write(f"CELL_TYPES {count}\n".encode())
        _write_numbers(file, grid.types, "i4", ascii, total)
        for head, data in ((f"POINT_DATA {len(grid.points)}", grid.node_data), (f"CELL_DATA {count}", grid.cell_data)):
            if data:
                file.write(f"{head}\n".encode())
                _write_arrays(path, file, data, ascii, total)


def _write_arrays(path: Path, file: BinaryIO, data: Mapping[str, object], ascii: bool, total: int) -> None:
    """Write arrays as a FIELD; raises `FileError` for a type that VTK does not have."""
    if data:
        file.write(f"FIELD FieldData {len(data)}\n".encode())
    for title, values in data.items():
        head = quote(title, safe=":", errors="replace") or "array"
        array = np.atleast_1d(np.asarray(values))
        if array.dtype.kind == "U" or (isinstance(values, (list, tuple)) and not len(values)):
            file.write(f"{head} 1 {array.size} string\n".encode())
            for text in array.ravel().tolist():
                file.write(quote(text, errors="replace").encode() + b"\n" if ascii else _with_length(text))
            file.write(b"\n")
            continue
        if array.dtype.kind == "b":
            array = array.astype(np.uint8)
        code = array.dtype.str[1:]
        if code not in NAMES:
            raise FileError(path, f"the array {title!r} holds {array.dtype}, which VTK cannot", "Remove the array.")
        flat = array.reshape(len(array), -1)
        file.write(f"{head} {flat.shape[1]} {len(flat)} {NAMES[code]}\n".encode())
        _write_numbers(file, flat, code, ascii, total)


def _write_numbers(file: BinaryIO, values: np.ndarray, code: str, ascii: bool, total: int) -> None:
    """Write rows of numbers; `total` is the size of all that are written, in bytes, for the progress."""
    if ascii:
        for part in row_chunks(len(values)):
            file.write(format_rows(values[part]))
            advance(values[part].nbytes, total)
    else:
        file.write(np.ascontiguousarray(values, dtype=f">{code}").tobytes() + b"\n")
        advance(values.nbytes, total)


def _with_length(text: str) -> bytes:
    """Encode a string after its length, whose first two bits tell its size in bytes: 11 one, 10 two, 01 four."""
    data = text.encode("utf-8", "replace")
    for size, mark in ((1, 3), (2, 2), (4, 1)):
        if len(data) < 1 << 8 * size - 2:
            return (len(data) | mark << 8 * size - 2).to_bytes(size, "big") + data
    raise ValueError("a string of more than a gigabyte")
