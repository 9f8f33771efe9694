"""OpenFOAM's polyMesh: a folder with points, faces, owner, neighbour and boundary, as text or binary, plain or gzip.

*OpenFOAM User Guide*, "Mesh description". A case is named by its folder or the `.foam` file in it. On writing, `points`
alone is replaced where the case has the same mesh; what else there is stays byte for byte.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.io.base.format import Capability, deferred, register
from hexmend.io.formats.openfoam.case import PARTS, SUFFIXES, ZONES, check_has_mesh, existing_part, find_case, times
from hexmend.mesh.mesh import Mesh

__all__ = ["find_case", "times"]


class CasePlace:
    """Folders and files of cases; see `hexmend.io.base.format.FolderPlace`."""

    def contains(self, path: Path) -> bool:
        """Return True for the folder or a file of a case; for a `.foam` file even if there is no mesh beside it."""
        return path.suffix.lower() in SUFFIXES or find_case(path) is not None

    def check_has_mesh(self, path: Path) -> None:
        """Raise `FileError` for a case whose mesh is divided among processes or not built."""
        check_has_mesh(path)

    def parts(self, path: Path) -> list[Path]:
        """Return the files of polyMesh that a mesh is read from; none without a mesh."""
        files = find_case(path)
        if files is None:
            return []
        others = [existing_part(files.mesh, name) for name in PARTS[1:] + ZONES]
        return [one for one in (files.points, *others) if one is not None and one.is_file()]

    def is_same(self, a: Path, b: Path) -> bool:
        """Return True if two paths lead to one case."""
        first, second = find_case(a), find_case(b)
        return first is not None and second is not None and first.points.resolve() == second.points.resolve()

    def check_target(self, path: Path, mesh: Mesh, source: Path | None) -> None:
        """Raise `FileError` for a case that has another mesh, and for a folder that a case cannot be copied to."""
        deferred("hexmend.io.formats.openfoam.writer:check_target")(path, mesh, source)


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
    locate=deferred("hexmend.io.formats.openfoam.writer:locate"),
    place=CasePlace(),
)
