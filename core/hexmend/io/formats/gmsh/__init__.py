"""Gmsh's format (.msh): versions 1, 2 and 4.1 are read, 4.1 is written, in decimals and binary."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base.format import FORMATS, Capability, Format
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read a Gmsh file: physical groups become sets, tags of nodes and elements ids."""
    from hexmend.io.formats.gmsh import reader as gmsh_read

    return gmsh_read.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 4.1: sets become physical groups."""
    from hexmend.io.formats.gmsh import writer as gmsh_write

    gmsh_write.write(path, mesh, encoding)


def cannot(mesh: Mesh) -> list[str]:
    """What it cannot hold of what it holds as a rule, in words."""
    from hexmend.io.formats.gmsh import writer as gmsh_write

    return gmsh_write.cannot(mesh)


def _recognised(head: bytes) -> bool:
    return b"$MeshFormat" in head or head.lstrip().startswith(b"$NOD")


HELD = (
    Capability.NODE_DATA,
    Capability.HEX_DATA,
    Capability.IDS,
    Capability.HEX_SETS,
    Capability.PINS,
    Capability.LOWER_CELLS,
)

FORMATS.add(
    "gmsh",
    Format(
        "gmsh",
        "Gmsh",
        (".msh",),
        ("binary", "ascii"),
        read,
        write,
        holds=frozenset(
            {*HELD, Capability.VERTICES, Capability.CELL_SETS, Capability.OTHER_CELLS, Capability.SECOND_ORDER}
        ),
        names=frozenset({"gmsh:physical"}),
        recognised=_recognised,
        cannot=cannot,
    ),
)
