"""MED, the format of Salome and Code_Aster (.med): meshes in HDF5, groups by families, data as fields."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base import hdf5
from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import FORMATS, Format, Holds
from hexmend.io.formats.med.writer import cannot, write
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read the first mesh of a file, in a process of its own, which the HDF5 library may end; groups are sets."""
    return to_mesh(path, hdf5.content_by("hexmend.io.formats.med.reader:content", path))


def _recognised(head: bytes) -> bool:
    """HDF5 with a group of meshes or, where that stands further on, the general information of MED."""
    return head.startswith(hdf5.MAGIC) and (b"ENS_MAA" in head or b"INFOS_GENERALES" in head)


HELD = (Holds.IDS, Holds.NODE_SETS, Holds.HEX_SETS, Holds.LOWER_CELLS, Holds.OTHER_CELLS, Holds.SECOND_ORDER)

FORMATS.add(
    "med",
    Format(
        "med",
        "MED",
        (".med",),
        ("binary",),
        read,
        write,
        holds=frozenset({*HELD, Holds.CELL_SETS, Holds.VERTICES, Holds.NODE_DATA, Holds.HEX_DATA, Holds.PINS}),
        recognised=_recognised,
        cannot=cannot,
    ),
)
