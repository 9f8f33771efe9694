"""Medit's format in decimals (.mesh), as documented by libMeshb.

Medit's format in binary (.meshb), versions 1 to 4, as documented by libMeshb.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.format import register
from hexmend.io.base.remedies import check_suffix
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, BinaryCoordinates, BinaryPiece
from hexmend.io.coordinates.text_coordinates import TextCoordinates, blanked, fields_of_words, word_ranges
from hexmend.io.formats.medit.content import DECLARATION, SECTIONS, from_mesh, to_mesh
from hexmend.io.storage.binary_rows import FileBytes
from hexmend.io.storage.file_progress import advance
from hexmend.mesh.mesh import Mesh

_KNOWN = {name.lower(): section for name, section in SECTIONS.items()} | {"hexaedra": SECTIONS["Hexahedra"]}


def read(path: Path) -> Mesh:
    """Read a Medit file; coordinates are read as float64 in every version of the format."""
    data = FileBytes(path)
    cursor = ByteCursor(path, data if data.find(b"#") < 0 else blanked(data[:], b"#"))
    return to_mesh(path, *_sections(cursor)[:4])


def locate(path: Path) -> TextCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    data = path.read_bytes()
    cursor = ByteCursor(path, blanked(data, b"#"))
    points, *_, place = _sections(cursor)
    first, last = word_ranges(cursor.data, *place)
    words = 4 * np.arange(len(points))[:, None] + np.arange(3)
    return TextCoordinates(data, points, fields_of_words(first[words], last[words]))


def _sections(
    cursor: ByteCursor,
) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray], list[str], tuple[int, int]]:
    """Read coordinates, references, other sections by name, names of unused ones, and the byte range of vertices."""
    if cursor.next_word() != "MeshVersionFormatted":
        raise cursor.error("does not begin with MeshVersionFormatted", check_suffix("a Medit file"))
    cursor.parse_count(cursor.next_word(), "the version")
    points = refs = place = None
    sections: dict[str, np.ndarray] = {}
    skipped: list[str] = []
    dimension = 0
    while not cursor.at_end:
        line, key = cursor.location, cursor.next_word()
        if key == "End":
            break
        if key == "Dimension":
            dimension = cursor.parse_count(cursor.next_word(), "Dimension")
            if dimension != 3:
                raise cursor.error(f"its Dimension is {dimension}: expected 3", "Hexmend works in space.")
        elif key == "Vertices":
            count = cursor.parse_count(cursor.next_word(), "the number of Vertices")
            begin = cursor.pos
            rows = cursor.read_numbers("Vertices", count, 4, np.float64)
            points, refs = np.ascontiguousarray(rows[:, :3]), _to_references(cursor, rows[:, 3])
            place = begin, cursor.pos
        elif key.lower() in _KNOWN:
            section = _KNOWN[key.lower()]
            count = cursor.parse_count(cursor.next_word(), f"the number of {section.name}")
            sections[section.name] = cursor.read_numbers(section.name, count, section.width, np.int64)
        elif key[:1].isalpha():
            skipped += [quoted(key)[1:-1]] if _skip(cursor) else []  # an unused section
        else:
            raise cursor.error(f"{quoted(key)} was found where a section should begin ({line})")
    if points is None:
        raise cursor.error("has no section Vertices")
    if not sections.keys() & {"Hexahedra", "Tetrahedra"} and not cursor.data[:].rstrip().endswith(b"End"):
        raise cursor.error(f"ends at {cursor.location} without Hexahedra")
    return points, refs, sections, skipped, place


def _to_references(cursor: ByteCursor, numbers: np.ndarray) -> np.ndarray:
    """Convert references of vertices to (n,) int64; they were read as floats together with the coordinates."""
    with np.errstate(invalid="ignore"):
        wrong = np.flatnonzero(~((numbers == np.rint(numbers)) & (np.abs(numbers) < 2.0**53)))
    if wrong.size:
        row = int(wrong[0])
        raise cursor.error(f"vertex {row + 1} has the reference {numbers[row]:g}: expected a whole number")
    return numbers.astype(np.int64)


def _skip(cursor: ByteCursor) -> bool:
    """Skip to the next word that begins with a letter; returns False for a section without content, which is 0."""
    words: list[str] = []  # the first two
    while not cursor.at_end:
        mark, word = cursor.pos, cursor.next_word()
        if word[:1].isalpha():
            cursor.pos = mark
            break
        if len(words) < 2:
            words.append(word)
    return words not in ([], ["0"])


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 2; decimals are the shortest that read as the same number."""
    points, refs, sections = from_mesh(mesh)
    total = len(points) + sum(map(len, sections.values()))
    with open(path, "wb") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n".encode())
        for part in row_chunks(len(points)):
            file.write(format_rows(points[part], refs[part]))
            advance(len(points[part]), total)
        for name, rows in sections.items():
            file.write(f"{name}\n{len(rows)}\n".encode())
            for part in row_chunks(len(rows)):
                file.write(format_rows(rows[part]))
                advance(len(rows[part]), total)
        file.write(b"End\n")


register("medit", "Medit", (".mesh",), ("ascii",), read, write, locate=locate, **DECLARATION)


#: Codes of sections.
_DIMENSION, _VERTICES, _END = 3, 4, 54
_BY_CODE = {section.code: section for section in SECTIONS.values()}


def read_binary(path: Path) -> Mesh:
    """Read a binary Medit file of either byte order."""
    return to_mesh(path, *_binary_sections(ByteCursor(path, FileBytes(path), is_text=False))[:4])


def locate_binary(path: Path) -> BinaryCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    points, *_, piece = _binary_sections(ByteCursor(path, FileBytes(path), is_text=False))
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


def _binary_sections(
    cursor: ByteCursor,
) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray], list[str], BinaryPiece]:
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


def write_binary(path: Path, mesh: Mesh, encoding: str) -> None:
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


register(
    "medit-binary",
    "binary Medit",
    (".meshb",),
    ("binary",),
    read_binary,
    write_binary,
    locate=locate_binary,
    **DECLARATION,
)
