"""Medit's format in binary (.meshb), versions 1 to 4, as documented by libMeshb."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.format import register
from hexmend.io.base.remedies import check_suffix
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, BinaryCoordinates, BinaryPiece
from hexmend.io.formats.medit.content import DECLARATION, SECTIONS, from_mesh, to_mesh
from hexmend.io.storage.binary_rows import FileBytes
from hexmend.io.storage.file_progress import advance
from hexmend.mesh.mesh import Mesh

#: Codes of sections.
_DIMENSION, _VERTICES, _END = 3, 4, 54
_BY_CODE = {section.code: section for section in SECTIONS.values()}


def read(path: Path) -> Mesh:
    """Read a binary Medit file of either byte order."""
    return to_mesh(path, *_sections(ByteCursor(path, FileBytes(path), is_text=False))[:4])


def locate(path: Path) -> BinaryCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    points, *_, piece = _sections(ByteCursor(path, FileBytes(path), is_text=False))
    return BinaryCoordinates(path, points, (piece,))


def _types(cursor: ByteCursor) -> tuple[str, str, str, str]:
    """Read the head: the byte order, and the types of whole numbers, coordinates and offsets."""
    head = cursor.read_bytes(4, "the head")
    order = {b"\x01\x00\x00\x00": "<", b"\x00\x00\x00\x01": ">"}.get(head)
    if order is None:
        raise cursor.error("does not begin with the number 1", check_suffix("a binary Medit file"))
    (version,) = struct.unpack(f"{order}i", cursor.read_bytes(4, "the version"))
    if not 1 <= version <= 4:
        raise cursor.error(f"is of version {version}: expected 1 to 4")
    integer = f"{order}i8" if version == 4 else f"{order}i4"
    real = f"{order}f4" if version == 1 else f"{order}f8"
    return order, integer, real, f"{order}q" if version >= 3 else f"{order}i"


def _sections(cursor: ByteCursor) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray], list[str], BinaryPiece]:
    """Read coordinates, references, other sections by name, names of unused ones, and the place of coordinates."""
    order, integer, real, offset = _types(cursor)
    points = refs = piece = None
    sections: dict[str, np.ndarray] = {}
    skipped: list[str] = []
    seen = 0
    while cursor.pos < len(cursor.data):
        at = cursor.pos
        (code,) = struct.unpack(f"{order}i", cursor.read_bytes(4, "a section's number"))
        if code == _END:
            break
        (after,) = struct.unpack(offset, cursor.read_bytes(struct.calcsize(offset), "the place of the next section"))
        if code == _DIMENSION:
            (dimension,) = struct.unpack(f"{order}i", cursor.read_bytes(4, "the dimension"))
            if dimension != 3:
                raise cursor.error(f"its dimension is {dimension}: expected 3", "Hexmend works in space.")
            continue
        seen += 1
        if code == _VERTICES or code in _BY_CODE:
            name = "Vertices" if code == _VERTICES else _BY_CODE[code].name
            count = int(cursor.read_binary(f"the number of {name}", 1, 1, integer)[0, 0])
            if count < 0:
                raise cursor.error(f"the number of {name} at byte {at} is {count}: expected a natural number")
            if code == _VERTICES:
                size = 3 * np.dtype(real).itemsize + np.dtype(integer).itemsize
                strides = (size, np.dtype(real).itemsize)
                piece = BinaryPiece(cursor.pos, np.dtype(real), strides, slice(0, count), ALL_COLUMNS)
                points, refs = _read_vertices(cursor, count, real, integer)
            else:
                sections[name] = cursor.read_integers(name, count, _BY_CODE[code].width, integer)
        elif not cursor.pos <= after <= len(cursor.data):
            raise cursor.error(f"the section of number {code} at byte {at} leads to byte {after}, outside the file")
        else:
            skipped += [f"number {code}"] if after - cursor.pos > np.dtype(integer).itemsize else []
            cursor.pos = after  # an unused section; without content it is a count of 0
    if points is None:
        raise cursor.error(f"has no section Vertices among its {seen}")
    return points, refs, sections, skipped, piece


def _read_vertices(cursor: ByteCursor, count: int, real: str, integer: str) -> tuple[np.ndarray, np.ndarray]:
    """Read coordinates, (count, 3) float64, and references, (count,) int."""
    blocks = cursor.binary_blocks("Vertices", count, 1, [("x", real, 3), ("ref", integer)])
    points, refs = np.empty((count, 3)), np.empty(count, integer[1:])
    for part, rows in blocks:
        points[part], refs[part] = rows["x"][:, 0], rows["ref"][:, 0]
    return points, refs


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 2, or version 3 where the offsets of version 2 would overflow."""
    points, refs, sections = from_mesh(mesh)
    large = len(points) * 28 + sum(rows.size * 4 + 12 for rows in sections.values()) > 2**31 - 1024
    version, offset = (3, "<q") if large else (2, "<i")
    limit = np.iinfo(np.int32)
    for name, rows in (("Vertices", refs), *sections.items()):
        if rows.size and (rows.min() < limit.min or rows.max() > limit.max):
            raise FileError(path, f"a reference of {name} needs more than 32 bits", "Write .mesh or .vtu instead.")
    total = len(points) + sum(map(len, sections.values()))
    vertices = np.empty(len(points), [("x", "<f8", 3), ("ref", "<i4")])
    vertices["x"], vertices["ref"] = points, refs
    with open(path, "wb") as file:

        def head(code: int, size: int) -> None:
            file.write(struct.pack("<i", code))
            file.write(struct.pack(offset, file.tell() + struct.calcsize(offset) + size))

        file.write(struct.pack("<ii", 1, version))
        head(_DIMENSION, 4)
        file.write(struct.pack("<i", 3))
        for code, rows in ((_VERTICES, vertices), *((SECTIONS[k].code, v.astype("<i4")) for k, v in sections.items())):
            head(code, 4 + rows.nbytes)
            file.write(struct.pack("<i", len(rows)))
            file.write(rows.tobytes())
            advance(len(rows), total)
        file.write(struct.pack("<i", _END))
        file.write(struct.pack(offset, 0))


register("medit-binary", "binary Medit", (".meshb",), ("binary",), read, write, locate=locate, **DECLARATION)
