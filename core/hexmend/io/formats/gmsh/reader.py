"""Reader of Gmsh's format, versions 1, 2, 4.0 and 4.1, text and (except version 1) binary, section by section.

It also locates the coordinates of a file in its section $Nodes.
"""

from __future__ import annotations

import struct
from codecs import BOM_UTF8
from functools import partial
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.remedies import check_suffix, some_names, unread_note
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, BinaryCoordinates, BinaryPiece
from hexmend.io.coordinates.located import CoordinatesError, LocatedCoordinates
from hexmend.io.coordinates.text_coordinates import TextCoordinates, fields_of_words, word_ranges
from hexmend.io.formats.gmsh import version_2, version_4
from hexmend.io.formats.gmsh.content import to_mesh, with_periodic_surfaces
from hexmend.io.formats.gmsh.data import DATA, read_data
from hexmend.io.formats.gmsh.sections import Sections
from hexmend.io.storage.binary_rows import FileBytes
from hexmend.mesh.mesh import Mesh

#: Readers of sections by version and keyword.
READERS = {
    1: {"$NOD": version_2.read_nod, "$ELM": version_2.read_elm},
    2: {"$Nodes": version_2.read_nodes, "$Elements": version_2.read_elements, "$Periodic": version_2.read_periodic}
    | {"$ParametricNodes": version_2.read_parametric_nodes},
    4: {"$Entities": version_4.read_entities, "$PartitionedEntities": version_4.read_partitioned_entities}
    | {"$Nodes": version_4.read_nodes, "$Elements": version_4.read_elements, "$Periodic": version_4.read_periodic},
    40: {
        "$Entities": partial(version_4.read_entities, is_4_0=True),
        "$Nodes": partial(version_4.read_nodes, is_4_0=True),
    }
    | {"$Elements": partial(version_4.read_elements, is_4_0=True)},
}


def read(path: Path) -> Mesh:
    """Read a Gmsh file: physical groups become sets, tags ids, periodic surfaces pairs of node sets.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For another version, or a section that is malformed or missing.
    MeshError
        From `Mesh`.
    """
    with open(path, "rb") as file:
        if not file.read(4096).removeprefix(BOM_UTF8).lstrip().startswith(b"$"):  # before all is read
            raise FileError(path, "does not begin with $MeshFormat", check_suffix("a Gmsh file"))
    source = ByteCursor(path, FileBytes(path))
    version, order, sections, skipped = 0, "", Sections(), {}
    while not source.at_end:
        key = source.next_line()
        if key == "$MeshFormat":
            version, order = read_format(source)
        elif key in READERS[version or 1]:  # the first version has no $MeshFormat
            version = version or 1
            READERS[version][key](source, order, sections)
        elif version and key == "$PhysicalNames":
            _read_physical_names(source, sections)
        elif version and key in DATA:
            read_data(source, order, key, sections)
        elif key.startswith("$") and not key.startswith("$End"):
            skip_section(source, key)
            skipped[quoted(key)[1:-1]] = None
        elif not version:
            raise source.error("does not begin with $MeshFormat", check_suffix("a Gmsh file"))
        else:
            raise source.error(f"{quoted(key)} was found where a section should begin, before {source.location}")
    if not version:
        raise source.error("has no section $MeshFormat")
    if skipped:
        sections.notes.append(unread_note(f"sections ({some_names(skipped)})"))
    return with_periodic_surfaces(path, to_mesh(path, sections), sections)


def read_format(source: ByteCursor) -> tuple[int, str]:
    """Version, 2, 4 (for 4.1) or 40 (for 4.0), and byte order, "<" or ">", of a binary file or "" of a text."""
    words = source.next_line().split()
    if len(words) != 3:
        raise source.error("$MeshFormat has no version, file type and data size")
    version, file_type, size = words
    if version not in ("2", "2.0", "2.1", "2.2", "4", "4.0", "4.1"):
        problem = f"is of version {quoted(version)} of the format: expected 1, 2, 4.0 or 4.1"
        raise source.error(problem, "Save it as 4.1 with Gmsh.")
    if file_type not in ("0", "1") or size != "8":
        found = f"{quoted(file_type)} and {quoted(size)}"
        raise source.error(f"its file type and data size are {found}: expected 0 or 1, and 8")
    order = ""
    if file_type == "1":
        one = source.read_bytes(4, "the number 1 that gives the byte order")
        order = "<" if struct.unpack("<i", one) == (1,) else ">"
        if struct.unpack(f"{order}i", one) != (1,):
            raise source.error("the number 1 that gives the byte order has another value")
        source.is_text = False
    if source.next_line() != "$EndMeshFormat":
        raise source.error("$MeshFormat ends without $EndMeshFormat")
    return 40 if version in ("4", "4.0") else int(version[0]), order


def _read_physical_names(source: ByteCursor, sections: Sections) -> None:
    """Read the lines of $PhysicalNames."""
    count = source.parse_count(source.next_line(), "the number of physical names")
    while (line := source.next_line()) != "$EndPhysicalNames":
        if not line:
            raise source.error("$PhysicalNames ends without $EndPhysicalNames")
        sections.names.append(line)
    if len(sections.names) != count:
        raise source.error(f"$PhysicalNames holds {len(sections.names)} names: expected {count}")


def skip_section(source: ByteCursor, key: str) -> None:
    """Skip the rest of a section, of its keyword."""
    end = f"$End{key[1:]}".encode()
    at = source.data.find(end, source.pos)
    if at < 0:
        raise source.error(f"{quoted(key)} ends without {quoted(end.decode())}")
    source.pos = at + len(end)


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    source, sections = ByteCursor(path, path.read_bytes()), Sections()
    version, order = 1, ""
    while not source.at_end:
        key, begin = source.next_line(), source.pos
        if key == "$MeshFormat":
            version, order = read_format(source)
        elif key in ("$NOD", "$Nodes", "$ParametricNodes"):
            READERS[version][key](source, order, sections)
            return _binary(source, order, sections) if order else _text(source, begin, sections)
        else:
            skip_section(source, key)
    raise CoordinatesError("it has no section $Nodes")


def _text(source: ByteCursor, begin: int, sections: Sections) -> TextCoordinates:
    """Coordinates among the words of a text from an offset on."""
    first, last = word_ranges(source.data, begin, source.pos)
    rows = [(at + stride * np.arange(count))[:, None] + np.arange(3) for at, count, stride in sections.places]
    words = np.concatenate([np.zeros((0, 3), np.int64), *rows])
    return TextCoordinates(source.data, sections.points, fields_of_words(first[words], last[words]))


def _binary(source: ByteCursor, order: str, sections: Sections) -> BinaryCoordinates:
    pieces, first, dtype = [], 0, np.dtype(f"{order}f8")
    for at, count, stride in sections.places:
        pieces.append(BinaryPiece(at, dtype, (stride, dtype.itemsize), slice(first, first + count), ALL_COLUMNS))
        first += count
    return BinaryCoordinates(source.path, sections.points, tuple(pieces))
