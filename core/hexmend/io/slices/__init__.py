"""Slices of mesh files: some of the cells and nodes, read without the others.

Opening of a mesh file that can be read in slices.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hexmend.io.format_lookup import format_of
from hexmend.io.formats.vtk.pvtu import piece_paths
from hexmend.io.slices.grid_slice import GridSlice, SlicedFile, slice_of
from hexmend.io.slices.vtkhdf_slices import VTKHDFSlices
from hexmend.io.slices.vtu_slices import VTUSlices

__all__ = ["GridSlice", "SlicedFile", "open_slices", "slice_of"]


def open_slices(path: Path) -> Sequence[SlicedFile] | None:
    """Open a mesh file, or all its pieces, to be read in slices.

    They are VTKHDF of one part; VTU of one piece, with its arrays as raw bytes behind the XML; and PVTU of such pieces
    with `GlobalNodeId` and `GlobalElementId`, as Hexmend writes them.

    Parameters
    ----------
    path : Path

    Returns
    -------
    sequence of SlicedFile or None
        None for other files, which can be read as a whole only.

    Raises
    ------
    FileError
        Where the file cannot be read at all.
    """
    format = format_of(path)
    files: list[SlicedFile | None] = []
    if format.name == "vtkhdf":
        files = [VTKHDFSlices.open(path)]
    elif format.name == "vtu":
        files = [VTUSlices.open(path)]
    elif format.name == "pvtu":
        files = [VTUSlices.open(piece, piece=True) for piece in piece_paths(path)]
    suitable = [file for file in files if file is not None]
    return suitable if files and len(suitable) == len(files) else None
