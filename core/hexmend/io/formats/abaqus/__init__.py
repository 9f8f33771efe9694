"""Abaqus's and CalculiX's input files (.inp): their mesh, with its sets and surfaces."""

from __future__ import annotations

import re
from pathlib import Path

from hexmend.io.base.format import Capability, Format, register
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read the mesh of an input file: its nodes, elements, sets and surfaces, of all instances of its parts."""
    from hexmend.io.formats.abaqus import reader as abaqus_read

    return abaqus_read.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, elements by their types, sets and surfaces."""
    from hexmend.io.formats.abaqus import writer as abaqus_write

    abaqus_write.write(path, mesh, encoding)


def _matches(head: bytes) -> bool:
    """Whether the first keyword is one that begins such a file."""
    found = re.search(rb"^[ \t]*\*(?!\*)[ \t]*([A-Za-z ]+)", head, re.MULTILINE)
    known = (b"HEADING", b"NODE", b"PART", b"PREPRINT", b"ELEMENT", b"ASSEMBLY", b"INCLUDE", b"PARAMETER")
    before = head[: found.start()] if found else b"x"
    return all(line.strip().startswith(b"**") or not line.strip() for line in before.split(b"\n")) and (
        found is not None and found[1].strip().upper() in known
    )


def _limitations(mesh: Mesh) -> list[str]:
    from hexmend.io.formats.abaqus import writer as abaqus_write

    return abaqus_write.limitations(mesh)


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
