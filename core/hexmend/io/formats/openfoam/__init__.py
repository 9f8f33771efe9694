"""OpenFOAM's polyMesh: a folder with points, faces, owner, neighbour and boundary, as text or binary, plain or gzip.

*OpenFOAM User Guide*, "Mesh description". A case is named by its folder or the `.foam` file in it. On writing, `points`
alone is replaced where the case has the same mesh; what else there is stays byte for byte.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base.format import Capability, deferred, register
from hexmend.io.formats.openfoam.case import SUFFIXES, find_case, times

__all__ = ["contains", "find_case", "times"]


def contains(path: Path) -> bool:
    """Return True for the folder or a file of a case; for its `.foam` file even if there is no mesh beside it."""
    return path.suffix.lower() in SUFFIXES or find_case(path) is not None


register(
    name="openfoam",
    title="OpenFOAM",
    suffixes=SUFFIXES,
    encodings=("ascii", "binary"),
    read=deferred("hexmend.io.formats.openfoam.reader:read"),
    write=deferred("hexmend.io.formats.openfoam.writer:write"),
    capabilities=frozenset(
        {Capability.HEX_SETS, Capability.NODE_SETS, Capability.SIDE_SETS, Capability.EMPTY_SETS, Capability.OTHER_CELLS}
    ),
    limitations=deferred("hexmend.io.formats.openfoam.writer:limitations"),
    contains=contains,
    replace_points=deferred("hexmend.io.formats.openfoam.writer:replace_points"),
    omissions=deferred("hexmend.io.formats.openfoam.writer:omissions"),
)
