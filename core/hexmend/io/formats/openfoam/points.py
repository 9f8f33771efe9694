"""Replacement of the coordinates in a file of points; its header, encoding and everything else stay as they are."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np

from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.lists import find_list


def replaced_points(path: Path, points: np.ndarray) -> bytes:
    """Return the content of a file of points with other coordinates.

    Parameters
    ----------
    path : Path
        The file; it is not changed.
    points : (n, 3) float64
        As many as the file holds. Decimals are the shortest that give the same number back.

    Returns
    -------
    bytes
        Compressed if the file is.

    Raises
    ------
    FileError
        For a damaged file, and one with another number of points.
    """
    file = FoamFile(path)
    data = file.data  # with comments
    span = find_list(file, "points", file.arch.scalar, 3)
    if span.count != len(points):
        problem = f"holds {span.count:,} points: expected {len(points):,}"
        raise file.error(problem, "Check whether the case was remeshed in the meantime.")
    new = points.astype(file.arch.scalar).tobytes() if file.is_binary else b"\n" + vector_rows(points)
    content = b"".join([data[: span.begin], new, data[span.end :]])
    return gzip.compress(content, 6) if file.is_compressed else content


def vector_rows(points: np.ndarray) -> bytes:
    """Format points as lines "(x y z)"."""
    parts = (format_rows(points[part]) for part in row_chunks(len(points)))
    return b"".join(b"(" + part[:-1].replace(b"\n", b")\n(") + b")\n" for part in parts)
