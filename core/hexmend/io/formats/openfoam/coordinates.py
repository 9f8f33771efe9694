"""Coordinates of a case, which are replaced in the case itself, in one with the same mesh, or in a copy.

Copies of cases without their results.
"""

from __future__ import annotations

import os
import shutil
import stat
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.formats.openfoam.case import CaseFiles, case_folder, find_case, is_time
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.foam_text import replaced_points
from hexmend.io.formats.openfoam.lists import read_vectors
from hexmend.io.formats.openfoam.writer import create_marker, file_errors, replace_points
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.io.storage.temporary_files import make_folder, temporary_folder


@dataclass(frozen=True, eq=False)
class CaseCoordinates:
    """Points of a case; see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : CaseFiles
    points : (n, 3) float64
    """

    files: CaseFiles
    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Replace the points of the case that the target names, or copy the case to a new folder with other points.

        Returns a sentence on results that are not copied, and on coordinates that are rounded.
        """
        known, notes = find_case(target), ()
        with file_errors(target):
            if known is not None:
                replace_points(known.points, points)
            else:
                content, root = replaced_points(self.files.part("points"), points), case_folder(target)
                make_folder(root.parent)
                left = results(self.files.root)
                with temporary_folder(root) as temporary:
                    _copy_folder(self.files.root, temporary, self.files, set(left), content)
                    if target.is_file():  # the .foam file, alone in the folder, which has to be empty now
                        os.replace(target, temporary / target.name)
                named = ", ".join([*left[:4], *(["..."] if len(left) > 4 else [])])
                notes = (f"The results of the case ({named}) are not copied.",) if left else ()
            create_marker(target)
        scalar = FoamFile(find_case(target).points).arch.scalar
        rounded = scalar.itemsize == 4 and FoamFile(find_case(target).points).is_binary
        return (*notes, *(["The case has coordinates of 32 bits: they are rounded."] if rounded else []))


def locate(path: Path) -> CaseCoordinates:
    """Find the points of a case; raises `FileError` where they cannot be read."""
    files = find_case(path)
    if files is None:
        raise FileError(path, "there is no OpenFOAM case", "Choose the folder of a case.")
    return CaseCoordinates(files, read_vectors(FoamFile(files.points), "points"))


#: Folders of results beside those of times.
_RESULTS = ("postProcessing", "VTK")


def results(root: Path) -> list[str]:
    """List the names in the folder of a case that are not copied: results of times but 0, and of processors."""

    def is_result(entry: Path) -> bool:
        later = is_time(entry.name) and float(entry.name) != 0
        return entry.is_dir() and (later or entry.name.startswith("processor") or entry.name in _RESULTS)

    return sorted(entry.name for entry in root.iterdir() if is_result(entry))


def _copy_folder(source: Path, target: Path, files: CaseFiles, omitted: set[str], points: bytes) -> None:
    own = files.part("points")
    for entry in sorted(source.iterdir()):
        new = target / entry.name
        if entry.name in omitted or entry.name.startswith(".hexmend-"):
            continue
        if entry == own:
            new.write_bytes(points)
        elif entry.is_dir() and not _is_link_inside(entry, files):
            new.mkdir()
            _copy_folder(entry, new, files, set(), points)
        elif entry.is_symlink() and (entry.is_dir() or not entry.exists()):
            os.symlink(os.readlink(entry), new)
        elif entry.is_file():  # no pipes and sockets
            shutil.copy2(entry, new)
            new.chmod(stat.S_IMODE(new.stat().st_mode) | stat.S_IWUSR)


def _is_link_inside(entry: Path, files: CaseFiles) -> bool:
    """Return True for a link to a folder of the case itself, unless it leads to the points."""
    if not entry.is_symlink() or files.mesh.is_relative_to(entry):
        return False
    return entry.resolve().is_relative_to(files.root.resolve())
