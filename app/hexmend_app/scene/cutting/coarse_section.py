"""Coarse picture of the faces that a cut opens, drawn while its planes move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.arrays import row_norms
from hexmend_app.picture.cut_shapes import Plane

#: Number of cells along the diagonal of the mesh; a cell is a few pixels wide.
_CELLS = 128


def coarse_section(
    points: np.ndarray, quads: np.ndarray, hexes: np.ndarray, planes: Sequence[Plane], diagonal: float
) -> tuple[np.ndarray, np.ndarray]:
    """Replace faces that are smaller than a cell by squares of lattices in the planes, one for each cell with faces.

    Parameters
    ----------
    points : (n, 3) float64
    quads : (k, 4) int32
        Nodes of faces near the planes.
    hexes : (k,) int64
        Hex of each face.
    planes : sequence of Plane
    diagonal : float
        Of the bounding box of the mesh.

    Returns
    -------
    corners : (4 j, 3) float64
        Corners of the squares and of the faces that are larger.
    hexes : (j,) int64
        Hex of each; of a square that of one of its faces.
    """
    cell = diagonal / _CELLS
    one, other = points[quads[:, 0]], points[quads[:, 2]]
    small = row_norms(other - one) < cell
    corners, owners = [points[quads[~small]].reshape(-1, 3)], [hexes[~small]]
    centres, hexes = 0.5 * (one + other)[small], hexes[small]
    distances = np.abs([plane.signed_distance(centres) for plane in planes])
    nearest = distances.argmin(axis=0) if len(planes) > 1 else np.zeros(len(centres), dtype=np.int64)
    for number, plane in enumerate(planes):
        own = nearest == number
        found, owner = _squares(centres[own], hexes[own], plane, cell)
        corners.append(found)
        owners.append(owner)
    return np.concatenate(corners), np.concatenate(owners)


def _squares(centres: np.ndarray, hexes: np.ndarray, plane: Plane, cell: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners of the squares of a plane in which centres of faces lie, (4 j, 3), and a hex of each, (j,)."""
    if not len(centres):
        return np.empty((0, 3)), hexes
    normal, offset = plane.equation
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    v = np.cross(normal, u)
    place = np.floor(np.stack([centres @ u, centres @ v], axis=1) / cell).astype(np.int64)
    low = place.min(axis=0)
    width, height = place.max(axis=0) - low + 1
    table = np.full(width * height, -1, dtype=np.int64)
    table[(place - low) @ (height, 1)] = hexes
    chosen = np.flatnonzero(table >= 0)
    first = np.stack(np.divmod(chosen, height), axis=1) + low
    at = cell * (first[:, None] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]))
    return (at[:, :, :1] * u + at[:, :, 1:] * v + offset * normal).reshape(-1, 3), table[chosen]
