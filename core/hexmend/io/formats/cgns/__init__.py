"""CGNS (.cgns), read: structured and unstructured zones of files on HDF5, as one mesh.

Files of the older kind, ADF, are read by VTK: its reader joins through the entry-point group `hexmend.formats`.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Format, register
from hexmend.mesh.mesh import Mesh

#: Marks of the two kinds near the beginning of a file.
ADF, ON_HDF5 = b"ADF Database", (b"HDF5 MotherNode", b"CGNSLibraryVersion")


def read(path: Path) -> Mesh:
    """Read a CGNS file, in a process of its own, which the HDF5 library may end."""
    with open(path, "rb") as file:
        head = file.read(64)
    if ADF in head:
        raise FileError(
            path, "is a CGNS file of the ADF kind", "pip install hexmend[app] reads it; or adf2hdf converts it."
        )
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.cgns.reader:content", path))


def matches(head: bytes) -> bool:
    """Whether a file begins as CGNS on HDF5 does."""
    return head.startswith(hdf5.MAGIC) and any(mark in head for mark in ON_HDF5)


register(
    Format(
        name="cgns",
        title="CGNS",
        suffixes=(".cgns",),
        encodings=(),
        read=read,
        matches=matches,
    )
)
