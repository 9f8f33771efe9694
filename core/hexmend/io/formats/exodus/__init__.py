"""ExodusII (.exo, .e, .g): element blocks, node, side and element sets, ids, and results of the last time step.

Schoof and Yarberry, *EXODUS II: A Finite Element Data Model*, SAND92-2137, and Sjaardema et al., *EXODUS: A Finite
Element Data Model*, for names, properties and 64-bit ids.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, Format, register
from hexmend.io.formats.exodus import netcdf3
from hexmend.io.formats.exodus.ids import IDS
from hexmend.io.formats.exodus.records import INFORMATION, QA
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read an ExodusII file; one on HDF5 in a subprocess, since the HDF5 library may crash on a damaged one."""
    from hexmend.io.formats.exodus.reader import content

    with open(path, "rb") as file:
        classic = file.read(3) == b"CDF"
    if classic:
        return to_mesh(path, content(path))
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.exodus.reader:content", path))


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write an ExodusII file of NetCDF's classic format, with 64-bit offsets."""
    from hexmend.io.formats.exodus import writer

    writer.write(path, mesh)


def limitations(mesh: Mesh) -> list[str]:
    """List the data of a mesh that a file cannot hold, in words."""
    from hexmend.io.formats.exodus import writer

    return writer.limitations(mesh)


def matches(head: bytes) -> bool:
    """Return True if a file begins like NetCDF, or like HDF5 with the names of ExodusII near its beginning."""
    if netcdf3.recognised(head):
        return True
    return head.startswith(hdf5.MAGIC) and any(mark in head for mark in (b"num_nodes", b"_NCProperties", b"coordx"))


register(
    Format(
        name="exodus",
        title="ExodusII",
        suffixes=(".exo", ".e", ".ex2", ".g", ".gen"),
        encodings=("binary",),
        read=read,
        write=write,
        capabilities=frozenset(
            {
                Capability.NODE_DATA,
                Capability.HEX_DATA,
                Capability.IDS,
                Capability.NODE_SETS,
                Capability.HEX_SETS,
                Capability.CELL_SETS,
                Capability.SIDE_SETS,
                Capability.FIXED_NODES,
                Capability.LOWER_CELLS,
                Capability.OTHER_CELLS,
                Capability.SECOND_ORDER,
            }
        ),
        stored_names=frozenset({IDS, QA, INFORMATION}),
        limitations=limitations,
        matches=matches,
    )
)
