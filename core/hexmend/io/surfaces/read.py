"""Reading a surface by suffix, and making one of the polygons of a file."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from hexmend.boundary import SkinSurface
from hexmend.errors import FileError
from hexmend.io.files import check_readable
from hexmend.io.surfaces.format import SURFACE_FORMATS, Polygons
from hexmend.mesh.components import components

#: Corners nearer to each other than this, as a share of the diagonal, are one; and a surface whose area is no larger a
#: share of the square of its extent has none.
_ONE = 1e-9


def read_surface(path: str | os.PathLike[str]) -> SkinSurface:
    """Read a surface of triangles, quads or polygons: what the boundary of a mesh can slide on.

    Parameters
    ----------
    path : path-like
        A file with the suffix of one of `SURFACE_FORMATS`.

    Returns
    -------
    SkinSurface
        Named after the file. Corners at one place are one; faces of more than four nodes are cut into triangles.

    Raises
    ------
    FileError
        For every reason why the file gives no surface.
    """
    path = Path(path)
    check_readable(path, "a file of a surface")
    format = next((one for one in SURFACE_FORMATS.values() if path.suffix.lower() in one.suffixes), None)
    if format is None:
        known = ", ".join(f"{suffix} ({one.title})" for one in SURFACE_FORMATS.values() for suffix in one.suffixes)
        raise FileError(path, f"the suffix {path.suffix!r} is none of a surface", f"Hexmend reads {known}.")
    try:
        found = format.read(path)
    except MemoryError:
        raise FileError(path, "needs more memory than there is", "Name a coarser surface.") from None
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None
    return _skin(path, found)


def _skin(path: Path, found: Polygons) -> SkinSurface:
    wrong = np.flatnonzero(~np.isfinite(found.points).all(axis=1))
    if wrong.size:
        at = found.points[wrong[0]].tolist()
        raise FileError(path, f"point {wrong[0]} (counted from 0) is at {at}: expected finite numbers", "Correct it.")
    for nodes in found.faces:
        if nodes.size and (nodes.min() < 0 or nodes.max() >= len(found.points)):
            wrong = int(nodes[(nodes < 0) | (nodes >= len(found.points))][0])
            raise FileError(
                path,
                f"a face uses the point {wrong}: expected numbers from 0 to {len(found.points) - 1}",
                "Correct it.",
            )
    faces = _of_one_width([nodes for nodes in found.faces if nodes.size and nodes.shape[1] > 2])
    points, faces = _merged(found.points, faces)
    # Faces without an extent have none: two corners, or those of a triangle on top of each other.
    distinct = np.sort(faces, axis=1)
    faces = faces[(distinct[:, 1:] != distinct[:, :-1]).sum(axis=1) >= 2]
    if not _area(points, faces) > _ONE:
        raise FileError(
            path, "holds no surface: it has no triangle or quad with an area", "Name a file of the surface of the body."
        )
    return SkinSurface(points, np.ascontiguousarray(faces, dtype=np.int32), path.name)


def _area(points: np.ndarray, faces: np.ndarray) -> float:
    """Twice the area of all faces, by the square of the longest side of their box; 0 where there are none."""
    if not len(faces):
        return 0.0
    x = points[faces]
    x = (x - x[0, 0]) / np.ptp(x.reshape(-1, 3), axis=0).max()  # (k, width, 3)
    sides = x[:, 1:] - x[:, :1]
    return float(np.linalg.norm(np.cross(sides[:, :-1], sides[:, 1:]), axis=2).sum())


def _of_one_width(faces: list[np.ndarray]) -> np.ndarray:
    """Faces of any widths as triangles, or, if there are quads, as quads, a triangle with its last node twice."""
    triangles = [nodes for nodes in faces if nodes.shape[1] == 3]
    for nodes in faces:
        if nodes.shape[1] > 4:
            triangles += [nodes[:, [0, k, k + 1]] for k in range(1, nodes.shape[1] - 1)]
    quads = [nodes for nodes in faces if nodes.shape[1] == 4]
    if not quads:
        return np.concatenate([np.empty((0, 3), np.int64), *triangles])
    return np.concatenate([*quads, *(nodes[:, [0, 1, 2, 2]] for nodes in triangles)])


def _merged(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The points that faces use, those at one place as one, and the faces with their numbers."""
    from scipy.spatial import cKDTree

    width = faces.shape[1]
    used, faces = np.unique(faces, return_inverse=True)
    if not used.size:
        return points[:0], faces.reshape(-1, width)
    points, place = np.unique(points[used], axis=0, return_inverse=True)
    near = cKDTree(points).query_pairs(_ONE * float(np.linalg.norm(np.ptp(points, axis=0))), output_type="ndarray")
    one = components(len(points), near)
    _, first = np.unique(one, return_index=True)
    return points[first], one[place.ravel()][faces].reshape(-1, width)
