"""Gmsh's format (.msh): versions 1, 2 and 4.1 are read, 4.1 is written, as text and binary.

*Gmsh Reference Manual*, "MSH file format" (version 4.1) and "Legacy formats" (versions 1 and 2).
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base.format import Capability, Format, register
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read a Gmsh file: physical groups become sets, tags of nodes and elements ids."""
    from hexmend.io.formats.gmsh import reader

    return reader.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 4.1: sets become physical groups."""
    from hexmend.io.formats.gmsh import writer

    writer.write(path, mesh, encoding)


def limitations(mesh: Mesh) -> list[str]:
    """List the data of a mesh that a file cannot hold, in words."""
    from hexmend.io.formats.gmsh import writer

    return writer.limitations(mesh)


def _matches(head: bytes) -> bool:
    """Return True if a file begins with $MeshFormat, or with $NOD as version 1 does."""
    return b"$MeshFormat" in head or head.lstrip().startswith(b"$NOD")


register(
    Format(
        name="gmsh",
        title="Gmsh",
        suffixes=(".msh",),
        encodings=("binary", "ascii"),
        read=read,
        write=write,
        capabilities=frozenset(
            {
                Capability.NODE_DATA,
                Capability.HEX_DATA,
                Capability.IDS,
                Capability.HEX_SETS,
                Capability.CELL_SETS,
                Capability.FIXED_NODES,
                Capability.LOWER_CELLS,
                Capability.VERTICES,
                Capability.OTHER_CELLS,
                Capability.SECOND_ORDER,
            }
        ),
        stored_names=frozenset({"gmsh:physical"}),
        limitations=limitations,
        matches=_matches,
    )
)
