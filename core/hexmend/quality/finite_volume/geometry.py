"""Centres and area vectors of faces, centres and volumes of cells, as OpenFOAM computes them.

Source: OpenFOAM, `primitiveMeshFaceCentresAndAreas.C` and `primitiveMeshCellCentresAndVols.C`. Coordinates come first
in the arrays, so that each operation reads and writes them in order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import bounds
from hexmend.mesh.solid_cells import rows_by_kind
from hexmend.mesh.validation import as_points_and_hexes

#: Number of hexes computed at a time: their arrays fit into the processor's cache.
CHUNK = 1 << 12


@dataclass(frozen=True, eq=False)
class CellGeometry:
    """Geometry of the faces and cells of a mesh.

    Parameters
    ----------
    points : (3, n) float64
        Coordinates from the centre of the bounding box, divided by `unit`.
    unit : float
        Power of two near the size of the bounding box: products of several lengths neither overflow nor vanish.
    face_centres, face_areas : (3, 6, m) float64
        Centres and area vectors of the faces of each cell, in the order of `hexmend.mesh.solid_cells`, 0 of a face that
        its kind does not have; an area vector is directed out of its cell. Unit `unit` and unit².
    centres : (3, m) float64
        Centres of the hexes.
    volumes : (m,) float64
        In unit³; negative for a hex turned inside out.
    """

    points: np.ndarray
    unit: float
    face_centres: np.ndarray
    face_areas: np.ndarray
    centres: np.ndarray
    volumes: np.ndarray


def cell_geometry(points: np.ndarray, hexes: np.ndarray) -> CellGeometry:
    """Compute the geometry of faces and cells.

    A face is divided into four triangles by the mean of its corners. Its area vector is the sum of theirs, its centre
    the mean of their centres, weighted by their areas. A cell is divided into six pyramids by the mean of its face
    centres. Its volume is the sum of theirs, its centre the mean of their centres, weighted by their volumes.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32

    Returns
    -------
    CellGeometry

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.
    """
    points, hexes = as_points_and_hexes(points, hexes)
    x, unit = in_unit(points, hexes)
    m = len(hexes)
    face_centres, face_areas = np.empty((3, 6, m)), np.empty((3, 6, m))
    centres, volumes = np.empty((3, m)), np.empty(m)
    for part in chunks(m):
        for kind, rows in rows_by_kind(hexes[part]):
            which = part if isinstance(rows, slice) else part.start + rows
            has = kind.faces[:, 0] >= 0
            areas, middles = np.zeros((2, 3, 6, len(hexes[which])))
            middles[:, has], areas[:, has] = _faces(x[:, hexes[which].T], kind.faces[has])
            face_centres[:, :, which], face_areas[:, :, which] = middles, areas
            centres[:, which], volumes[which] = _cells(middles[:, has], areas[:, has])
    return CellGeometry(x, unit, face_centres, face_areas, centres, volumes)


def in_unit(points: np.ndarray, hexes: np.ndarray) -> tuple[np.ndarray, float]:
    """Return coordinates from the centre of the box of the hexes, in a unit near its size.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int

    Returns
    -------
    coordinates : (3, n) float64
    unit : float
        A power of two.
    """
    used = points[hexes.ravel()] if len(hexes) * 8 < len(points) else points
    if not len(used):
        return np.zeros((3, len(points))), 1.0
    low, high = bounds(used)
    centre, size = low / 2 + high / 2, float((high / 2 - low / 2).max())
    exponent = int(np.frexp(size)[1]) if size > 0 else 0
    # In two steps, as the unit's reciprocal may overflow.
    x = np.ldexp(points / 2 - centre / 2, -(exponent // 2))
    return np.ascontiguousarray(np.ldexp(x, exponent // 2 - exponent + 1).T), float(np.ldexp(1.0, min(exponent, 1023)))


def chunks(count: int) -> Iterator[slice]:
    """Divide a range into slices of `CHUNK`."""
    return (slice(first, first + CHUNK) for first in range(0, count, CHUNK))


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross product of vectors (3, ...)."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Scalar product of vectors (3, ...)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a: np.ndarray) -> np.ndarray:
    """Lengths of vectors (3, ...)."""
    return np.sqrt(dot(a, a))


def divide(a: np.ndarray, b: np.ndarray, otherwise: np.ndarray | float) -> np.ndarray:
    """Compute a / b, and `otherwise` where b is 0 or the quotient is not finite."""
    sound = b != 0
    with np.errstate(over="ignore", invalid="ignore"):
        quotient = a / np.where(sound, b, 1.0)
    return np.where(sound & np.isfinite(quotient), quotient, otherwise)


def _faces(corners: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres and area vectors (3, f, k) of the faces (f, 4) of cells of one kind with these corners (3, 8, k)."""
    p = corners[:, faces]  # (3, f, 4, k)
    middle = p.mean(axis=2)
    triangle = faces[:, 2] == faces[:, 3]
    if triangle.any():
        middle[:, triangle] = p[:, triangle, :3].mean(axis=2)
    after = p[:, :, [1, 2, 3, 0]]
    normals = cross(after - p, middle[:, :, None] - p)  # twice the area vectors of the triangles
    areas = norm(normals)
    total = areas.sum(axis=1)
    weighted = (areas * (p + after + middle[:, :, None])).sum(axis=2)
    return divide(weighted, 3 * total, middle), normals.sum(axis=2) / 2


def _cells(face_centres: np.ndarray, face_areas: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres (3, k) and volumes (k,) of cells with these faces (3, f, k)."""
    estimate = face_centres.mean(axis=1)
    pyramids = dot(face_areas, face_centres - estimate[:, None])  # three times their volumes
    total = pyramids.sum(axis=0)
    weighted = (pyramids * (0.75 * face_centres + 0.25 * estimate[:, None])).sum(axis=1)
    return divide(weighted, total, estimate), total / 3
