"""Writing of VTK's legacy format, version 3.0, in decimals and binary."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO
from urllib.parse import quote

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.numbering import runs
from hexmend.io.formats.vtk.grid import from_mesh
from hexmend.io.storage.file_progress import advance
from hexmend.mesh.mesh import Mesh

#: VTK's names of NumPy types.
NAMES = {
    "u1": "unsigned_char", "i1": "char", "i2": "short", "u2": "unsigned_short", "i4": "int", "u4": "unsigned_int",
    "i8": "long", "u8": "unsigned_long", "f4": "float", "f8": "double",
}  # fmt: skip


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
