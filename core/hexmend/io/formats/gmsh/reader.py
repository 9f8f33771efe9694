"""Reads Gmsh's format, versions 1, 2 and 4.1, in decimals and (but for version 1) binary, section by section."""

from __future__ import annotations

import struct
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.formats.gmsh.content import Read, to_mesh
from hexmend.io.formats.gmsh.data import DATA, read_data
from hexmend.io.formats.gmsh.version_1 import read_elements as elements_1
from hexmend.io.formats.gmsh.version_1 import read_nodes as nodes_1
from hexmend.io.formats.gmsh.version_2 import read_elements as elements_2
from hexmend.io.formats.gmsh.version_2 import read_nodes as nodes_2
from hexmend.io.formats.gmsh.version_4 import read_elements as elements_4
from hexmend.io.formats.gmsh.version_4 import read_entities as entities_4
from hexmend.io.formats.gmsh.version_4 import read_nodes as nodes_4
from hexmend.io.formats.gmsh.version_4 import read_partitioned
from hexmend.mesh.mesh import Mesh

_SECTIONS = {
    1: {"$NOD": nodes_1, "$ELM": elements_1},
    2: {"$Nodes": nodes_2, "$Elements": elements_2},
    4: {
        "$Entities": entities_4,
        "$PartitionedEntities": read_partitioned,
        "$Nodes": nodes_4,
        "$Elements": elements_4,
    },
}


def read(path: Path) -> Mesh:
    """Read a Gmsh file: physical groups become sets, tags of nodes and elements ids."""
    with open(path, "rb") as file:
        if not file.read(4096).lstrip().startswith(b"$"):  # said before all of a large file is read
            raise FileError(path, "does not begin with $MeshFormat", "Is it a Gmsh file? Check its suffix.")
    source = ByteCursor(path, path.read_bytes())
    version, order, result, left = 0, "", Read(), {}
    while not source.at_end:
        key = source.next_line()
        if key == "$MeshFormat":
            version, order = _head(source)
        elif key in _SECTIONS[version or 1]:  # the first version has no $MeshFormat
            version = version or 1
            _SECTIONS[version][key](source, order, result)
        elif version and key == "$PhysicalNames":
            _names(source, result)
        elif version and key in DATA:
            read_data(source, order, key, result)
        elif key.startswith("$") and not key.startswith("$End"):
            _skip(source, key)
            left[quoted(key)[1:-1]] = None
        elif not version:
            raise source.error("does not begin with $MeshFormat", "Is it a Gmsh file? Check its suffix.")
        else:
            raise source.error(f"{quoted(key)} stands where a section should begin, before {source.location}")
    if not version:
        raise source.error("has no section $MeshFormat")
    if left:
        result.notes.append(f"Sections that are not kept ({', '.join(list(left)[:6])}) are left out.")
    return to_mesh(path, result)


def _head(source: ByteCursor) -> tuple[int, str]:
    """2 or 4, and the order of a binary file's bytes, "" for one in decimals."""
    words = source.next_line().split()
    if len(words) != 3:
        raise source.error("$MeshFormat has no version, file type and data size")
    version, kind, size = words
    if version not in ("2", "2.0", "2.1", "2.2", "4.1"):
        raise source.error(
            f"is of version {quoted(version)} of the format: expected 2.2 or 4.1", "Save it as 4.1 with Gmsh."
        )
    if kind not in ("0", "1") or size != "8":
        raise source.error(f"its file type and data size are {quoted(kind)} and {quoted(size)}: expected 0 or 1, and 8")
    order = ""
    if kind == "1":
        one = source.read_bytes(4, "the number 1 that tells the order of bytes")
        order = "<" if struct.unpack("<i", one) == (1,) else ">"
        if struct.unpack(f"{order}i", one) != (1,):
            raise source.error("the number 1 that tells the order of bytes is another")
        source.is_text = False
    if source.next_line() != "$EndMeshFormat":
        raise source.error("$MeshFormat ends without $EndMeshFormat")
    return int(version[0]), order


def _names(source: ByteCursor, result: Read) -> None:
    count = source.parse_count(source.next_line(), "the number of physical names")
    while (line := source.next_line()) != "$EndPhysicalNames":
        if not line:
            raise source.error("$PhysicalNames ends without $EndPhysicalNames")
        result.names.append(line)
    if len(result.names) != count:
        raise source.error(f"$PhysicalNames holds {len(result.names)} names: expected {count}")


def _skip(source: ByteCursor, key: str) -> None:
    end = f"$End{key[1:]}".encode()
    at = source.data.find(end, source.pos)
    if at < 0:
        raise source.error(f"{quoted(key)} ends without {quoted(end.decode())}")
    source.pos = at + len(end)
