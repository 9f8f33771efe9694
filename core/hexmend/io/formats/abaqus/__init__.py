"""Input files of Abaqus and CalculiX (.inp): nodes, elements, sets and surfaces.

*Abaqus Keywords Guide*: *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, *PART and *INSTANCE; data of other keywords are left
out.
"""

from __future__ import annotations

import re
from pathlib import Path

from hexmend.io.base.format import Capability, Format, register
from hexmend.mesh.mesh import Mesh

_FIRST_KEYWORDS = (b"HEADING", b"NODE", b"PART", b"PREPRINT", b"ELEMENT", b"ASSEMBLY", b"INCLUDE", b"PARAMETER")


def read(path: Path) -> Mesh:
    """Read the mesh of an input file: the nodes, elements, sets and surfaces of all instances of its parts."""
    from hexmend.io.formats.abaqus import reader

    return reader.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, elements by type, sets and surfaces."""
    from hexmend.io.formats.abaqus import writer

    writer.write(path, mesh)


def _matches(head: bytes) -> bool:
    """Return True if the first keyword, after comments and blank lines, is one that begins an input file."""
    found = re.search(rb"^[ \t]*\*(?!\*)[ \t]*([A-Za-z ]+)", head, re.MULTILINE)
    before = head[: found.start()].split(b"\n") if found else []
    comments = all(line.strip().startswith(b"**") or not line.strip() for line in before)
    return found is not None and comments and found[1].strip().upper() in _FIRST_KEYWORDS


def _limitations(mesh: Mesh) -> list[str]:
    """List the data of a mesh that a file cannot hold, in words."""
    from hexmend.io.formats.abaqus import writer

    return writer.limitations(mesh)


register(
    Format(
        name="abaqus",
        title="Abaqus",
        suffixes=(".inp",),
        encodings=("ascii",),
        read=read,
        write=write,
        capabilities=frozenset(
            {
                Capability.IDS,
                Capability.NODE_SETS,
                Capability.HEX_SETS,
                Capability.CELL_SETS,
                Capability.SIDE_SETS,
                Capability.LOWER_CELLS,
                Capability.VERTICES,
                Capability.OTHER_CELLS,
                Capability.SECOND_ORDER,
            }
        ),
        stored_names=frozenset({"abaqus:type", "abaqus:types"}),
        limitations=_limitations,
        matches=_matches,
    )
)
