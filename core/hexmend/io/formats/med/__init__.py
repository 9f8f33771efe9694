"""MED, the format of Salome and Code_Aster (.med): meshes in HDF5, groups by families, data as fields.

*MED file format*, version 4.1 (EDF, CEA): structure of the HDF5 file, numbering of elements, families and fields.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, Format, register
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read the first mesh of a file, in a subprocess, since the HDF5 library may crash on a damaged one."""
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.med.reader:content", path))


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 4.1: sets become groups, data become fields."""
    from hexmend.io.formats.med import writer

    writer.write(path, mesh)


def limitations(mesh: Mesh) -> list[str]:
    """List the data of a mesh that a file cannot hold, in words."""
    from hexmend.io.formats.med import writer

    return writer.limitations(mesh)


def _matches(head: bytes) -> bool:
    """Return True if a file begins like HDF5, with the group of MED's meshes or of its general information."""
    return head.startswith(hdf5.MAGIC) and (b"ENS_MAA" in head or b"INFOS_GENERALES" in head)


register(
    Format(
        name="med",
        title="MED",
        suffixes=(".med",),
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
                Capability.FIXED_NODES,
                Capability.LOWER_CELLS,
                Capability.VERTICES,
                Capability.OTHER_CELLS,
                Capability.SECOND_ORDER,
            }
        ),
        limitations=limitations,
        matches=_matches,
    )
)
