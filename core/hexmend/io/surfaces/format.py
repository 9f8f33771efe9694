"""What a file format of surfaces is, and the registry in which these formats announce themselves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.registry import Registry


@dataclass(frozen=True, eq=False)
class Polygons:
    """What a file of a surface holds.

    Parameters
    ----------
    points : (n, 3) float64
    faces : list of (k, width) int64
        Nodes of the faces, from 0, those of one width together.
    """

    points: np.ndarray
    faces: list[np.ndarray]


@dataclass(frozen=True)
class SurfaceFormat:
    """A file format of surfaces, as its module declares it.

    Parameters
    ----------
    name : str
        The key in SURFACE_FORMATS.
    title : str
        What people call it.
    suffixes : tuple of str
        Lower case, with the dot.
    read : callable
        From path to Polygons; raises FileError, and OSError where the file system fails.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    read: Callable[[Path], Polygons]


#: Every format by name.
SURFACE_FORMATS: Registry[SurfaceFormat] = Registry("surface format")

DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."


def parse_surface(path: Path, title: str, parse: Callable[[], Polygons]) -> Polygons:
    """What a parser makes of a file; whatever it raises becomes a `FileError`: each of its failures is another one."""
    try:
        return parse()
    except (FileError, MemoryError, OSError):
        raise
    except Exception as error:
        detail = " ".join(str(error).split()) or type(error).__name__
        raise FileError(path, f"cannot be read as {title} ({detail[:120]})", DAMAGED) from None


def polygons_from_meshlane(found) -> Polygons:
    """The faces of a mesh of meshlane's; its other cells are left out."""
    kinds = ("triangle", "quad", "polygon")
    faces = [np.asarray(block.data, dtype=np.int64) for block in found.cells if block.type in kinds]
    return Polygons(np.asarray(found.points, dtype=np.float64).reshape(-1, 3), faces)


def group_by_width(start: np.ndarray, nodes: np.ndarray) -> list[np.ndarray]:
    """Faces as compressed rows, start (k + 1,) and nodes, put together by their number of nodes."""
    widths = np.diff(start)
    return [nodes[start[:-1][widths == width, None] + np.arange(width)] for width in np.unique(widths)]
