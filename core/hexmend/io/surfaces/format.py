"""Content of a surface file, and helpers of the readers of all formats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.remedies import DAMAGED


@dataclass(frozen=True, eq=False)
class Polygons:
    """Content of a surface file.

    Parameters
    ----------
    points : (n, 3) float64
    faces : list of (k, width) int64
        Nodes of the faces, from 0, grouped by width.
    """

    points: np.ndarray
    faces: list[np.ndarray]


def parse_surface(path: Path, title: str, parse: Callable[[], Polygons]) -> Polygons:
    """Call a parser whose exceptions of any type become a `FileError`.

    Parameters
    ----------
    path : Path
        Named in errors.
    title : str
        Name of the format, for errors.
    parse : callable
        parse() returns Polygons.
    """
    try:
        return parse()
    except (FileError, MemoryError, OSError):
        raise
    except Exception as error:
        detail = " ".join(str(error).split()) or type(error).__name__
        raise FileError(path, f"cannot be read as {title} ({detail[:120]})", DAMAGED) from None


def polygons_from_meshlane(mesh: object) -> Polygons:
    """Take the points and faces of a mesh from meshlane; other cells are left out."""
    kinds = ("triangle", "quad", "polygon")
    faces = [np.asarray(block.data, dtype=np.int64) for block in mesh.cells if block.type in kinds]
    return Polygons(np.asarray(mesh.points, dtype=np.float64).reshape(-1, 3), faces)


def group_by_width(start: np.ndarray, nodes: np.ndarray) -> list[np.ndarray]:
    """Group faces by their number of nodes.

    Parameters
    ----------
    start : (k + 1,) int
        Face i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int

    Returns
    -------
    list of (j, width) int array
    """
    widths = np.diff(start)
    return [nodes[start[:-1][widths == width, None] + np.arange(width)] for width in np.unique(widths)]
