"""CGNS (.cgns), read only: structured and unstructured zones of files on HDF5, as one mesh.

*The CGNS Standard Interface Data Structures* (SIDS) and the "CGNS File Mapping Manual". Files of the older ADF kind are
read by VTK: its reader joins through the entry-point group `hexmend.formats`.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import register
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import install_hint

#: Texts near the beginning of files of the two kinds.
ADF_MARK, HDF5_MARKS = b"ADF Database", (b"HDF5 MotherNode", b"CGNSLibraryVersion")


def read(path: Path) -> Mesh:
    """Read a CGNS file in a subprocess, since the HDF5 library may crash on a damaged one."""
    with open(path, "rb") as file:
        head = file.read(64)
    if ADF_MARK in head:
        remedy = f"For a reader {install_hint('app')}; or adf2hdf converts it."
        raise FileError(path, "is a CGNS file of the ADF kind", remedy)
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.cgns.reader:content", path))


def matches(head: bytes) -> bool:
    """Return True if a file begins like CGNS on HDF5."""
    return head.startswith(hdf5.MAGIC) and any(mark in head for mark in HDF5_MARKS)


register(name="cgns", title="CGNS", suffixes=(".cgns",), encodings=(), read=read, matches=matches)
