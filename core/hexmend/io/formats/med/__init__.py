"""MED, the format of Salome and Code_Aster (.med): meshes in HDF5, groups by families, data as fields.

*MED file format*, version 4.1 (EDF, CEA): structure of the HDF5 file, numbering of elements, families and fields.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, deferred, register
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read the first mesh of a file, in a subprocess, since the HDF5 library may crash on a damaged one."""
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.med.reader:content", path))


register(
    name="med",
    title="MED",
    suffixes=(".med",),
    encodings=("binary",),
    read=read,
    write=deferred("hexmend.io.formats.med.writer:write"),
    capabilities=frozenset(Capability) - {Capability.SIDE_SETS, Capability.EMPTY_SETS, Capability.FIELD_DATA},
    limitations=deferred("hexmend.io.formats.med.writer:limitations"),
    matches=lambda head: head.startswith(hdf5.MAGIC) and (b"ENS_MAA" in head or b"INFOS_GENERALES" in head),
    locate=deferred("hexmend.io.formats.med.reader:locate"),
)
