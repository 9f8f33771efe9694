"""ExodusII (.exo, .e, .g): element blocks, node, side and element sets, ids, and results of the last time step.

Schoof and Yarberry, *EXODUS II: A Finite Element Data Model*, SAND92-2137, and Sjaardema et al., *EXODUS: A Finite
Element Data Model*, for names, properties and 64-bit ids.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, deferred, register
from hexmend.io.formats.exodus import netcdf3
from hexmend.io.formats.exodus.records import IDS
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read an ExodusII file; one on HDF5 in a subprocess, since the HDF5 library may crash on a damaged one."""
    content = "hexmend.io.formats.exodus.reader:content"
    if netcdf3.is_classic(path):
        return to_mesh(path, deferred(content)(path))
    return to_mesh(path, hdf5.read_content(content, path))


def matches(head: bytes) -> bool:
    """Return True if a file begins like NetCDF, or like HDF5 with the names of ExodusII near its beginning."""
    if netcdf3.recognised(head):
        return True
    return head.startswith(hdf5.MAGIC) and any(mark in head for mark in (b"num_nodes", b"_NCProperties", b"coordx"))


register(
    name="exodus",
    title="ExodusII",
    suffixes=(".exo", ".e", ".ex2", ".g", ".gen"),
    encodings=("binary",),
    read=read,
    write=deferred("hexmend.io.formats.exodus.writer:write"),
    capabilities=frozenset(Capability) - {Capability.EMPTY_SETS, Capability.VERTICES, Capability.FIELD_DATA},
    stored_names=frozenset({IDS}),
    limitations=deferred("hexmend.io.formats.exodus.writer:limitations"),
    matches=matches,
    locate=deferred("hexmend.io.formats.exodus.reader:locate"),
)
