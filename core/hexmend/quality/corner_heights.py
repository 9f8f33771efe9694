"""Heights of hexes at their corners, which bound the time step of explicit solvers."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.solid_cells import SolidKind, rows_by_kind
from hexmend.mesh.validation import as_points_and_hexes
from hexmend.quality.finite_volume.geometry import chunks, cross, divide, dot, norm


def least_heights(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the least height of each hex over its eight corners and the three faces at each.

    With the edges u, v, w at a corner, the height over the face of v and w is u·(v x w) / |v x w|. Of a parallelepiped
    the least is its volume over its largest face.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32

    Returns
    -------
    (m,) float64
        In the unit of the points: negative for an inverted hex, 0 where a face has no area at a corner.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> least_heights(UNIT_CUBE * [1, 2, 0.5], np.arange(8)[None])
    array([0.5])
    """
    points, hexes = as_points_and_hexes(points, hexes)
    least = np.empty(len(hexes))
    for kind, rows in rows_by_kind(hexes):
        least[rows] = _of_kind(points, hexes[rows], kind)
    return least


def _of_kind(points: np.ndarray, cells: np.ndarray, kind: SolidKind) -> np.ndarray:
    """Compute the least heights of cells (m, 8) of one kind, (m,)."""
    least = np.empty(len(cells))
    for part in chunks(len(cells)):
        x = points[cells[part]].transpose(2, 1, 0)  # (3, 8, k)
        with np.errstate(over="ignore", invalid="ignore"):
            x = x - x[:, :1]
        x, exponent = _near_one(x)
        apex, *ends = (x[:, kind.corners[:, i]] for i in range(4))
        edges = [end - apex for end in ends]
        faces = [cross(edges[(i + 1) % 3], edges[(i + 2) % 3]) for i in range(3)]
        volume, area = dot(edges[0], faces[0]), np.max([norm(face) for face in faces], axis=0)
        # The largest face has the least height if the corner is not inverted; the smallest has it otherwise.
        area = np.where(volume > 0, area, np.min([norm(face) for face in faces], axis=0))
        heights = divide(volume, area, 0.0).min(axis=0)
        with np.errstate(over="ignore"):
            least[part] = np.ldexp(heights, exponent)
    return least


def _near_one(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Divide the coordinates (3, 8, k) of each hex by a power of two near its size, and return the exponents (k,)."""
    size = np.abs(x).max(axis=(0, 1))
    exponent = np.where((size > 0) & np.isfinite(size), np.frexp(size)[1], 0)
    half = exponent // 2  # in two steps, as the power itself may not be a number
    return np.ldexp(np.ldexp(x, -half), half - exponent), exponent
