"""Copies of cases without their results."""

from __future__ import annotations

import os
import shutil
import stat
from pathlib import Path

from hexmend.io.formats.openfoam.case import CaseFiles, is_time

#: Folders of results beside those of times.
_RESULTS = ("postProcessing", "VTK")


def results(root: Path) -> list[str]:
    """List the names in the folder of a case that are not copied: results of times but 0, and of processors."""

    def is_result(entry: Path) -> bool:
        later = is_time(entry.name) and float(entry.name) != 0
        return entry.is_dir() and (later or entry.name.startswith("processor") or entry.name in _RESULTS)

    return sorted(entry.name for entry in root.iterdir() if is_result(entry))


def copy_case(files: CaseFiles, target: Path, points: bytes) -> None:
    """Copy a case without its results, with other points.

    Links to files are followed; links to folders are followed if these are outside the case.

    Parameters
    ----------
    files : CaseFiles
        The case to copy.
    target : Path
        An empty folder.
    points : bytes
        New content of the file points.

    Raises
    ------
    OSError
        Where a file cannot be read or written.
    """
    _copy_folder(files.root, target, files, set(results(files.root)), points)


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
