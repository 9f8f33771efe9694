"""Patches of the boundary, and zones of cells, faces and points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import is_number, quoted
from hexmend.io.formats.openfoam.case import CaseFiles, existing_part
from hexmend.io.formats.openfoam.foam_file import FoamFile, Value
from hexmend.io.formats.openfoam.lists import find_list, read_labels

#: Files of zones, and the entry that lists the members of each zone.
ZONE_FILES = {"cellZones": "cellLabels", "faceZones": "faceLabels", "pointZones": "pointLabels"}
#: Patch of the faces of the boundary that belong to no other.
DEFAULT_PATCH = "defaultFaces"
#: Dictionaries that include one another.
_MAX_INCLUDES = 8


@dataclass(frozen=True)
class Patch:
    """Faces of the boundary with one condition.

    Parameters
    ----------
    name : str
    type : str
        Such as wall, patch, symmetryPlane, empty, wedge or cyclic.
    first, count : int
        Number of the first face, and number of faces.
    neighbour : str
        Name of the other patch of a cyclic pair; empty for other patches.
    """

    name: str
    type: str
    first: int
    count: int
    neighbour: str = ""

    @property
    def faces(self) -> np.ndarray:
        """Numbers of the faces, (count,) int64."""
        return np.arange(self.first, self.first + self.count)


def read_patches(path: Path, n_internal: int, n_faces: int) -> list[Patch]:
    """Read the file boundary.

    Parameters
    ----------
    path : Path
    n_internal, n_faces : int
        Number of faces between two cells, and of all faces.

    Returns
    -------
    list of Patch

    Raises
    ------
    FileError
        For a patch that is incomplete, or whose faces are not of the boundary.
    """
    file = FoamFile(path)
    patches = [_patch(file, name, entries) for name, entries in _named_dictionaries(file)]
    for patch in patches:
        if patch.count and (patch.first < n_internal or patch.first + patch.count > n_faces):
            faces = f"the faces {patch.first} to {patch.first + patch.count - 1}"
            expected = f"expected faces of the boundary, {n_internal} to {n_faces - 1}"
            raise file.error(f"patch {quoted(patch.name)} has {faces}: {expected}")
    names = {patch.name for patch in patches}
    for patch in patches:
        if patch.neighbour and patch.neighbour not in names:
            problem = f"patch {quoted(patch.name)} has the neighbourPatch {quoted(patch.neighbour)}"
            raise file.error(f"{problem}, which does not exist", "Correct the name.")
    return patches


def read_zones(files: CaseFiles, name: str, count: int) -> dict[str, np.ndarray]:
    """Read a file of zones.

    Parameters
    ----------
    files : CaseFiles
    name : str
        One of `ZONE_FILES`; the file may be missing.
    count : int
        Number of cells, faces or points of the mesh.

    Returns
    -------
    dict of str to (k,) int64
        Members of each zone.

    Raises
    ------
    FileError
        For a damaged file, and for members that do not exist.
    """
    path = existing_part(files.mesh, name)
    if path is None:
        return {}
    file, zones = FoamFile(path), {}
    key = ZONE_FILES[name]
    begin = file.pos
    if file.peek().isdigit():
        file.count(f"the number of {name}")
        file.expect("(", name)
    else:
        file.pos = begin
    while (zone := file.token()) not in (")", ""):
        zone = zone.strip('"')
        file.expect("{", f"zone {quoted(zone)}")
        members = _members(file, zone, key)
        outside = members[(members < 0) | (members >= count)]
        if outside.size:
            problem = f"zone {quoted(zone)} refers to {outside[0]}"
            raise file.error(f"{problem}: expected numbers from 0 to {count - 1}")
        zones[zone] = members
    return zones


def _members(file: FoamFile, zone: str, wanted: str) -> np.ndarray:
    """Read the entries of a zone and the brace behind them; return its members."""
    members, label = np.zeros(0, np.int64), f"zone {quoted(zone)}"
    while (key := file.token()) != "}":
        if not key or key in "{}();[]":
            raise file.error(f"{label} continues with {file.shown(key)}: expected a name or '}}'")
        if key == wanted:
            if file.peek().startswith("List<"):
                file.token()
            members = read_labels(file, f"{key} of {label}")
            file.expect(";", label)
        elif key == "flipMap":
            _skip_flips(file, label)
        else:
            file.entry(f"{label}, {quoted(key)}")
    return members


def _skip_flips(file: FoamFile, label: str) -> None:
    if file.peek().startswith("List<"):
        file.token()
    begin = file.pos
    file.count(f"the length of flipMap of {label}")
    if file.peek() == "{":
        file.token(), file.token()
        file.expect("}", label)
    else:
        file.pos = begin
        find_list(file, f"flipMap of {label}", np.dtype(np.uint8), 1)
    file.expect(";", label)


def _named_dictionaries(file: FoamFile, depth: int = 0) -> Iterator[tuple[str, Mapping[str, Value]]]:
    """Dictionaries of a list, with their names; those of included files come in their place."""
    if file.peek().isdigit():
        file.count("the number of patches")
    listed = file.peek() == "("
    if listed:
        file.token()
    while (name := file.token()) != (")" if listed else ""):
        if name in ("#include", "#includeIfPresent"):
            yield from _included(file, file.token().strip('"'), name == "#include", depth)
            continue
        if not name or name in "{}();[]" or name.startswith("#"):
            raise file.error(f"the list of patches continues with {file.shown(name)}: expected a name or ')'")
        name = name.strip('"')
        file.expect("{", f"patch {quoted(name)}")
        yield name, file.dictionary(f"patch {quoted(name)}")


def _included(file: FoamFile, name: str, required: bool, depth: int) -> Iterator[tuple[str, Mapping[str, Value]]]:
    """Dictionaries of an included file, which may have no header."""
    path = file.path.parent / name
    if depth >= _MAX_INCLUDES:
        raise file.error(f"includes {quoted(name)} too deeply", "Check that no file includes itself.")
    if not path.is_file():
        if required:
            raise file.error(f"includes {quoted(name)}, which does not exist", "Copy it, or remove #include.")
        return
    yield from _named_dictionaries(FoamFile(path, has_header=False), depth + 1)


def _patch(file: FoamFile, name: str, entries: Mapping[str, Value]) -> Patch:
    label = f"patch {quoted(name)}"
    kind, other = file.word(entries, "type", label), file.word(entries, "neighbourPatch", label, "")
    numbers = {
        key: _count(file, file.word(entries, key, label), f"{key} of {label}") for key in ("nFaces", "startFace")
    }
    return Patch(name, kind, numbers["startFace"], numbers["nFaces"], other)


def _count(file: FoamFile, word: str, label: str) -> int:
    if not is_number(word):
        raise file.error(f"{label} is {quoted(word)}: expected a natural number")
    return int(word)
