"""Coordinates of a case, which are replaced in the case itself, in one with the same mesh, or in a copy."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.formats.openfoam.case import CaseFiles, case_folder, find_case
from hexmend.io.formats.openfoam.case_copy import copy_case, results
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.lists import read_vectors
from hexmend.io.formats.openfoam.points import replaced_points
from hexmend.io.formats.openfoam.writer import create_marker, file_errors, replace_points
from hexmend.io.storage.temporary_files import make_folder
from hexmend.io.storage.temporary_folder import temporary_folder


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

    def write(self, file: Path, target: Path, points: np.ndarray) -> tuple[str, ...]:
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
                with temporary_folder(root) as temporary:
                    copy_case(self.files, temporary, content)
                    if target.is_file():  # the .foam file, alone in the folder, which has to be empty now
                        os.replace(target, temporary / target.name)
                left = results(self.files.root)
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
