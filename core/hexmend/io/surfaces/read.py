"""Reading of a surface file by its suffix.

Merging of the points of a surface whose faces do not share them, such as the triangles of an STL file.

Meshes whose boundary slides on the surface of a file.

Files of curves: chains of nodes as text, one in each line.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from hexmend.arrays import cross_products, extent, mask, row_norms
from hexmend.boundary import SkinSurface
from hexmend.boundary.marking import with_curve
from hexmend.errors import FileError, MeshError
from hexmend.io.base.numbering import first_out_of_range
from hexmend.io.files import check_readable, reading
from hexmend.io.surfaces.formats import Polygons, read_legacy, read_obj, read_ply, read_stl, read_vtp
from hexmend.kernels import closest_point
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.close_pairs import close_pairs
from hexmend.mesh.topology.components import components


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


#: Title of each format, and its reader, by suffix.
SURFACE_FORMATS: dict[str, tuple[str, Callable[[Path], Polygons]]] = {
    ".stl": ("STL", read_stl),
    ".obj": ("OBJ", read_obj),
    ".ply": ("PLY", read_ply),
    ".vtp": ("VTP", read_vtp),
    ".vtk": ("VTK legacy", read_legacy),
}
#: Points at a smaller distance, relative to the diagonal of the bounding box, are merged.
_MERGE_TOLERANCE = 1e-9


def merge_points(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Drop unused points and merge those that coincide up to rounding.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, w) int

    Returns
    -------
    points : (j, 3) float64
        Different points, in the order of the file.
    faces : (k, w) int
        Faces of these points.
    """
    used = mask(faces.ravel(), len(points))
    if not used.any():
        return points[:0], faces
    if not used.all():
        points, faces = points[used], (np.cumsum(used) - 1)[faces]
    group = closest_point.numbers_of_different_points(points)
    points = points[np.unique(group, return_index=True)[1]]
    distance = _MERGE_TOLERANCE * float(np.linalg.norm(extent(points)))
    pairs = close_pairs(points, distance)
    if len(pairs):
        merged = components(len(points), pairs)
        _, first = np.unique(merged, return_index=True)
        points, group = points[first], merged[group]
    return points, group.take(faces)


#: Smallest area, relative to the square of the extent.
_MIN_AREA = 1e-9
_FACES_AT_A_TIME = 1024


def read_surface(path: str | os.PathLike[str]) -> SkinSurface:
    """Read a surface of triangles, quads or polygons, on which the boundary of a mesh can slide.

    Parameters
    ----------
    path : path-like
        A file of one of `SURFACE_FORMATS`, by its suffix.

    Returns
    -------
    SkinSurface
        Named after the file. Coincident corners are merged; faces of more than four nodes are split into triangles.

    Raises
    ------
    FileError
        Where the file cannot be read as a surface.
    """
    path = Path(path)
    check_readable(path, "a file of a surface")
    _, read = SURFACE_FORMATS.get(path.suffix.lower(), ("", None))
    if read is None:
        titles = [f"{suffix} ({title})" for suffix, (title, _) in SURFACE_FORMATS.items()]
        remedy = f"Hexmend reads {', '.join(titles)}."
        raise FileError(path, f"the suffix {path.suffix!r} is none of a surface", remedy)
    with reading(path, "Choose a coarser surface."):
        polygons = read(path)
    return _to_surface(path, polygons)


def _to_surface(path: Path, polygons: Polygons) -> SkinSurface:
    if not np.isfinite(polygons.points).all():
        wrong = np.flatnonzero(~np.isfinite(polygons.points).all(axis=1))
        at = polygons.points[wrong[0]].tolist()
        raise FileError(path, f"point {wrong[0]} (counted from 0) is at {at}: expected finite numbers", "Correct it.")
    for nodes in polygons.faces:
        outside = first_out_of_range(nodes, len(polygons.points))
        if outside is not None:
            expected = f"expected numbers from 0 to {len(polygons.points) - 1}"
            raise FileError(path, f"a face uses the point {outside}: {expected}", "Correct it.")
    faces = _with_equal_width([nodes for nodes in polygons.faces if nodes.size and nodes.shape[1] > 2])
    points, faces = merge_points(polygons.points, faces)
    # Drop faces with fewer than three different corners.
    sound = np.count_nonzero(np.diff(np.sort(faces, axis=1), axis=1), axis=1) >= 2
    faces = faces if sound.all() else faces[sound]
    if not _has_area(points, faces):
        problem = "holds no surface: it has no triangle or quad with an area"
        raise FileError(path, f"{problem}{_far_point(polygons.points)}", "Choose a file with the surface of the body.")
    return SkinSurface(points, faces.astype(np.int32), path.name)


def _far_point(points: np.ndarray) -> str:
    """Name the point beside whose distance the other points are all at one place; "" if there is none."""
    if not len(points):
        return ""
    away = np.abs(points - np.median(points, axis=0)).max(axis=1)
    far = int(away.argmax())
    if not np.median(away) < _MIN_AREA * away[far]:
        return ""
    return f" beside point {far} (counted from 0), which is far from the others at {points[far].tolist()}"


def _has_area(points: np.ndarray, faces: np.ndarray) -> bool:
    """Return True if twice the area of all faces exceeds that share of the square of their longest extent."""
    if not len(faces):
        return False
    points = points - points[faces[0, 0]]
    x, area = points / extent(points[mask(faces, len(points))]).max(), 0.0
    for first in range(0, len(faces), _FACES_AT_A_TIME):  # a few of them tell it of most surfaces
        corners = x[faces[first : first + _FACES_AT_A_TIME]]  # (k, width, 3)
        sides = corners[:, 1:] - corners[:, :1]
        area += float(row_norms(cross_products(sides[:, :-1].reshape(-1, 3), sides[:, 1:].reshape(-1, 3))).sum())
        if area > _MIN_AREA:
            return True
    return False


def _with_equal_width(faces: list[np.ndarray]) -> np.ndarray:
    """Convert faces to triangles or, if there are quads, to quads; a triangle then has its last node twice."""
    triangles = [nodes for nodes in faces if nodes.shape[1] == 3]
    for nodes in faces:
        if nodes.shape[1] > 4:
            triangles += [nodes[:, [0, k, k + 1]] for k in range(1, nodes.shape[1] - 1)]
    quads = [nodes for nodes in faces if nodes.shape[1] == 4]
    if not quads:
        return np.concatenate([np.empty((0, 3), np.int64), *triangles])
    return np.concatenate([*quads, *(nodes[:, [0, 1, 2, 2]] for nodes in triangles)])


def sliding_on_file(mesh: Mesh, path: str | os.PathLike[str]) -> Mesh:
    """Return the mesh with the surface of a file for its boundary to slide on; see `Mesh.sliding_on`.

    Parameters
    ----------
    mesh : Mesh
    path : path-like
        A file that `read_surface` reads.

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        If the file cannot be read as a surface.
    MeshError
        If the surface is far from the boundary.
    """
    return mesh.sliding_on(read_surface(path))


def sliding_on_boundary(mesh: Mesh) -> Mesh:
    """Return the mesh with its own boundary to slide on, as without `sliding_on_file`."""
    return mesh.sliding_on(None)
