"""Times of an OpenFOAM case at which points are stored: the same mesh, moved by the solver."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hexmend.errors import FileError
from hexmend.io.formats.openfoam.case import existing_part, find_case, times
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.lists import read_vectors


class CaseTime(NamedTuple):
    """Points of a case at a time.

    Parameters
    ----------
    value : float
        Time in seconds.
    path : Path
        File of the points.
    points : (n, 3) float64 or None
        None if they cannot be used.
    error : FileError or None
        The reason; its problem names the time.
    """

    value: float
    path: Path
    points: np.ndarray | None
    error: FileError | None


def read_times(path: Path, n_points: int) -> Iterator[CaseTime]:
    """Read the points of each time at which the mesh of a case is stored, in order, one at a time.

    Parameters
    ----------
    path : Path
        As of `find_case`. Nothing is read for a mesh other than that in constant, such as the folder of a time.
    n_points : int
        Number of points of the mesh in constant.

    Yields
    ------
    CaseTime
        With an error instead of points for a damaged file, and for points of another mesh: of another number, or of a
        time with faces of its own or after one.
    """
    files = find_case(path)
    if files is None or files.points.parent != files.mesh or not files.mesh.is_relative_to(files.root / "constant"):
        return
    remeshed = None
    for value, file in times(path):
        if existing_part(file.parent, "faces") is not None:
            remeshed = value
        try:
            yield CaseTime(value, file, _read_points(file, value, n_points, remeshed), None)
        except FileError as error:
            yield CaseTime(value, file, None, error)


def _read_points(path: Path, value: float, n_points: int, remeshed: float | None) -> np.ndarray:
    """Read the points of a time; the mesh has had its own faces since the time `remeshed`, unless that is None."""
    at = f"t = {value:.12g}"
    if remeshed is not None:
        raise FileError(path, f"{at}: the case has other faces since t = {remeshed:.12g}", "Open that time's polyMesh.")
    try:
        points = read_vectors(FoamFile(path), "points")
    except FileError as error:
        raise FileError(path, f"{at}: {error.problem}", error.remedy) from error
    if len(points) != n_points:
        problem = f"{at}: holds {len(points):,} points, expected {n_points:,} as in constant"
        raise FileError(path, problem, "Check whether the case was remeshed in the meantime.")
    if not np.isfinite(points).all():
        row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise FileError(path, f"{at}: point {row} is not finite", "Check whether the solver diverged.")
    return points
