"""MED, the format of Salome and Code_Aster (.med): meshes in HDF5, groups by families, data as fields."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, Format, register
from hexmend.io.formats.med.writer import limitations, write
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read the first mesh of a file, in a process of its own, which the HDF5 library may end; groups are sets."""
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.med.reader:content", path))


def _matches(head: bytes) -> bool:
    """HDF5 with a group of meshes or, where that stands further on, the general information of MED."""
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
