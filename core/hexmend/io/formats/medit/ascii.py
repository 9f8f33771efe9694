"""Medit's format in decimals (.mesh), as documented by libMeshb."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.format import register
from hexmend.io.base.remedies import check_suffix
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
