"""Files of an OpenFOAM case: its folder, the polyMesh folder, and the points of its times."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from hexmend.errors import FileError

#: Suffixes of the empty file by which ParaView opens a case.
SUFFIXES = (".foam", ".openfoam")
#: Files of a polyMesh folder by which it can be opened; each may be compressed (.gz).
PARTS = ("points", "faces", "owner", "neighbour", "boundary")
#: Files of zones in a polyMesh folder, which need not exist.
ZONES = ("cellZones", "faceZones", "pointZones")
_TIME = re.compile(r"[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?\Z")


@dataclass(frozen=True)
class CaseFiles:
    """Location of a mesh of an OpenFOAM case.

    Parameters
    ----------
    root : Path
        Folder of the case.
    mesh : Path
        The polyMesh folder with faces, owners and patches.
    points : Path
        File of the coordinates; of a later time where the mesh moves.
    """

    root: Path
    mesh: Path
    points: Path

    def part(self, name: str) -> Path:
        """Find a file of the polyMesh folder, plain or compressed; raises `FileError` if there is none."""
        found = existing_part(self.mesh, name)
        if found is None:
            remedy = "Copy the whole folder, or name another case."
            raise FileError(self.mesh, f"has no file {name}", remedy)
        return found


def find_case(path: Path) -> CaseFiles | None:
    """Find the mesh of a case.

    Parameters
    ----------
    path : Path
        Folder of a case, its constant or polyMesh folder, the folder of a time with moved points, the case's `.foam`
        file, or a file in a polyMesh folder.

    Returns
    -------
    CaseFiles or None
        None if there is no such mesh.
    """
    if path.is_dir():
        folder = path.absolute()
        nested = (folder / "constant" / "polyMesh", folder / "polyMesh", folder)
    elif path.suffix.lower() in SUFFIXES:
        nested = (path.absolute().parent / "constant" / "polyMesh",)
    elif path.is_file() and path.name.removesuffix(".gz") in PARTS:
        nested = (path.absolute().parent,)
    else:
        return None
    return next((files for folder in nested if (files := _files_of(folder)) is not None), None)


def check_has_mesh(path: Path) -> None:
    """Raise `FileError` for the folder or `.foam` file of a case without a mesh; it names the command that makes one.

    Parameters
    ----------
    path : Path
    """
    folder = path if path.is_dir() else path.absolute().parent
    if find_case(path) is None and (folder / "processor0").is_dir():
        remedy = "Run reconstructParMesh -constant in it, or open a part, such as processor0."
        raise FileError(path, "is a case whose mesh is divided among processes (processor0...)", remedy)
    if find_case(path) is None and (folder / "system" / "controlDict").is_file():
        has_blocks = any((folder / at / "blockMeshDict").is_file() for at in ("system", "constant/polyMesh"))
        mesher = "blockMesh" if has_blocks else "its mesher, such as blockMesh,"
        raise FileError(path, "is a case without constant/polyMesh: its mesh is not built", f"Run {mesher} in it.")


def case_folder(path: Path) -> Path:
    """Return the folder of the case that is written under a path: the path itself, or the folder of its `.foam` file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Path
        Absolute.
    """
    files = find_case(path)
    if files is not None:
        return files.root
    return path.absolute().parent if path.suffix.lower() in SUFFIXES else path.absolute()


def times(path: Path) -> list[tuple[float, Path]]:
    """List the times of a case at which its points are stored, in order.

    Parameters
    ----------
    path : Path
        As of `find_case`; of a region, its own points are listed.

    Returns
    -------
    list of (float, Path)
        Time in seconds, and the file of the points; the mesh in constant is not among them.
    """
    files = find_case(Path(path))
    if files is None:
        return []
    constant = files.root / "constant"
    mesh = files.mesh.relative_to(constant) if files.mesh.is_relative_to(constant) else Path("polyMesh")
    found = []
    for folder in files.root.iterdir():
        points = existing_part(folder / mesh, "points") if is_time(folder.name) else None
        if points is not None:
            found.append((float(folder.name), points))
    return sorted(found)


def is_time(name: str) -> bool:
    """Return True for the name of a folder of results, such as 0.002."""
    return _TIME.match(name) is not None


def existing_part(folder: Path, name: str) -> Path | None:
    """Return the path of a file of a polyMesh folder, plain or compressed; None if there is none."""
    return next((path for path in (folder / name, folder / f"{name}.gz") if path.is_file()), None)


def _files_of(folder: Path) -> CaseFiles | None:
    """Files of a polyMesh folder; one with points alone takes the faces from constant."""
    points, root = existing_part(folder, "points"), _root_of(folder)
    if existing_part(folder, "faces") is not None:
        return CaseFiles(root, folder, points or folder / "points")
    constant = root / "constant" / "polyMesh"
    if points is not None and existing_part(constant, "faces") is not None:
        return CaseFiles(root, constant, points)
    return None


def _root_of(folder: Path) -> Path:
    """Folder of the case that a polyMesh folder belongs to: above constant or a time, with a region between or not."""
    for parent in list(folder.parents)[:2]:
        if parent.name == "constant" or is_time(parent.name):
            return parent.parent
    return folder.parent if folder.name == "polyMesh" else folder
