"""Files of curves: chains of nodes as text, one in each line."""

from __future__ import annotations

import os
from pathlib import Path

from hexmend.boundary.marking import with_curve
from hexmend.errors import FileError, MeshError
from hexmend.io.files import check_readable, reading
from hexmend.mesh.mesh import Mesh


def with_curves_of_file(mesh: Mesh, path: str | os.PathLike[str]) -> Mesh:
    """Return the mesh with the curves of a file marked; see `with_curve`.

    Parameters
    ----------
    mesh : Mesh
    path : path-like
        Text with a chain in each line: numbers of nodes, counted from 0, separated by spaces or commas. What follows
        # is a comment.

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For a file that cannot be read, and for the first line that is no chain of boundary edges.
    """
    path = Path(path)
    check_readable(path, "a file of curves")
    with reading(path, "Choose a text file of node numbers."):
        lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        words = line.partition("#")[0].replace(",", " ").split()
        if not words:
            continue
        try:
            mesh = with_curve(mesh, _nodes(words))
        except MeshError as error:
            raise FileError(path, f"line {number}: {error}", "Correct the line.") from None
    return mesh


def _nodes(words: list[str]) -> list[int]:
    wrong = next((word for word in words if not word.isdecimal()), None)
    if wrong is not None:
        raise MeshError(f"{wrong!r} is not a node number: expected whole numbers, counted from 0")
    if len(words) < 2:
        raise MeshError("there is one node: expected two or more, joined by edges")
    return [int(word) for word in words]
