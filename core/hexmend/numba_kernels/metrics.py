"""Metrics of every hex by its edges, diagonals, principal axes and corners, as the Verdict library defines them.

Stimpson, Ernst, Knupp, Pébay and Thompson: The Verdict Geometric Quality Library, SAND2007-1751. One pass writes the
metrics that share its lengths. Angles, warpage and volume go by faces: `kernels.faces`.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import DIAGONALS, EDGES, UNIT_CUBE
from hexmend.numba_kernels import CHUNK, lanes, parallel, serial
from hexmend.numba_kernels.elements import load
from hexmend.numba_kernels.lanes import ALL, CORNERS, LANES, ROW, WORK, S
from hexmend.numba_kernels.shape import determinant, power_minus_two_thirds

_SIDES = 2 * UNIT_CUBE.T - 1  # where each corner lies from the centre, -1 or 1, along x, y and z

#: Signs of the corners in the principal axes X1, X2, X3 and the cross derivatives X12, X23, X31 of the manual, (6, 8).
_AXES = np.concatenate([_SIDES, _SIDES * _SIDES[[1, 2, 0]]])


@serial
def load_from_first(points, hexes, h, x):
    """Write the corners of hex h, less its first one, into x (8, 3): sums of them are as exact far from the origin."""
    for c in range(8):
        for k in range(3):
            x[c, k] = points[hexes[h, c], k] - points[hexes[h, 0], k]


@serial
def _distances(x, pairs):
    """The least and the greatest distance of pairs of corners (k, 2)."""
    least, greatest = np.inf, 0.0
    for i in range(pairs.shape[0]):
        square = 0.0
        for k in range(3):
            d = x[pairs[i, 1], k] - x[pairs[i, 0], k]
            square += d * d
        least, greatest = min(least, square), max(greatest, square)
    return np.sqrt(least), np.sqrt(greatest)


@parallel
def lengths(points, hexes, edge_ratio, stretch, diagonal):
    """Ratios of edges and diagonals; E the twelve edges' lengths, D the four diagonals'.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    edge_ratio : (m,) float64, written
        max E / min E; +inf where an edge has no length.
    stretch : (m,) float64, written
        sqrt(3) min E / max D; 0 where neither edge nor diagonal has a length, +inf where only diagonals have none.
    diagonal : (m,) float64, written
        min D / max D; 0 where no diagonal has a length.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x = np.empty((8, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load(points, hexes, h, x)
            shortest, longest = _distances(x, EDGES)
            narrow, wide = _distances(x, DIAGONALS)
            edge_ratio[h] = longest / shortest if shortest > 0 else np.inf
            stretch[h] = np.sqrt(3.0) * shortest / wide if shortest > 0 else 0.0
            diagonal[h] = narrow / wide if wide > 0 else 0.0


@serial
def _sum_axes(x, w):
    """Principal axes of the hex with corners x (8, 3), and cross derivatives if there is room, into w (3 or 6, 3)."""
    for i in range(w.shape[0]):
        for k in range(3):
            total = 0.0
            for c in range(8):
                total += _AXES[i, c] * x[c, k]
            w[i, k] = total


@serial
def _lengths_of_rows(w, lengths):
    """Lengths of the rows of w (6, 3)."""
    for i in range(6):
        lengths[i] = np.sqrt(w[i, 0] * w[i, 0] + w[i, 1] * w[i, 1] + w[i, 2] * w[i, 2])


@serial
def _by_axes(w, lengths):
    """Aspect ratio, skew and taper of a hex with axes and cross derivatives w (6, 3) of these lengths (6,)."""
    least, greatest = min(lengths[0], lengths[1], lengths[2]), max(lengths[0], lengths[1], lengths[2])
    if not (least > 0 and greatest < np.inf):
        return np.inf, 1.0, np.inf
    skew, taper = 0.0, 0.0
    for i in range(3):
        j = (i + 1) % 3
        dot = w[i, 0] * w[j, 0] + w[i, 1] * w[j, 1] + w[i, 2] * w[j, 2]
        skew = max(skew, abs(dot) / (lengths[i] * lengths[j]))
        taper = max(taper, lengths[3 + i] / min(lengths[i], lengths[j]))
    return greatest / least, min(skew, 1.0), taper


@parallel
def axes(points, hexes, aspect_ratio, skew, taper):
    """Figures of the principal axes X1, X2, X3, the sums of the four edges along x, y and z.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    aspect_ratio : (m,) float64, written
        max |Xi| / min |Xi|, Verdict's "maximum edge ratio"; +inf where an axis has no length.
    skew : (m,) float64, written
        Greatest |cos| of the angle of two axes; 1 where an axis has no length.
    taper : (m,) float64, written
        Greatest |Xij| / min(|Xi|, |Xj|), Xij the cross derivatives; +inf where an axis has no length.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, w, lengths = np.empty((8, 3)), np.empty((6, 3)), np.empty(6)
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load_from_first(points, hexes, h, x)
            _sum_axes(x, w)
            _lengths_of_rows(w, lengths)
            aspect_ratio[h], skew[h], taper[h] = _by_axes(w, lengths)


#: Rows in which `corners` keeps what it has found of each hex.
_FULLEST, _CONDITION = ROW[9], ROW[10]


@serial
def _judge(w):
    """Take the tetrahedra in S into the extremes of their hexes."""
    for i in range(ALL):
        ux, uy, uz = w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i]
        vx, vy, vz = w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i]
        wx, wy, wz = w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i]
        ax, ay, az = vy * wz - vz * wy, vz * wx - vx * wz, vx * wy - vy * wx
        bx, by, bz = wy * uz - wz * uy, wz * ux - wx * uz, wx * uy - wy * ux
        cx, cy, cz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        det = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        length = np.sqrt(ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz)
        area = np.sqrt(ax * ax + ay * ay + az * az + bx * bx + by * by + bz * bz + cx * cx + cy * cy + cz * cz)
        sound = (det > 0) & (det < np.inf)
        fullness = det / (length * length * length) if sound else 0.0
        condition = length * area / (3 * det) if sound else np.inf
        w[_FULLEST + i] = min(w[_FULLEST + i], fullness)
        w[_CONDITION + i] = max(w[_CONDITION + i], condition)


@parallel
def corners(points, hexes, shape, condition):
    """Figures of the eight corner tetrahedra, with edges S = [e1, e2, e3] and sigma = det S.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    shape : (m,) float64, written
        Least 3 sigma^(2/3) / |S|^2; 0 where sigma <= 0.
    condition : (m,) float64, written
        Greatest |S| |S^-1| / 3, Frobenius norms; +inf where sigma <= 0.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + lanes.CHUNK - 1) // lanes.CHUNK):
        x, w = np.empty(CORNERS), np.empty(WORK)
        end = min(m, (chunk + 1) * lanes.CHUNK)
        for begin in range(chunk * lanes.CHUNK, end, LANES):
            count = min(LANES, end - begin)
            lanes.load(points, hexes, begin, count, x)
            lanes.fill(w, _FULLEST, _FULLEST + ALL, np.inf)
            lanes.fill(w, _CONDITION, _CONDITION + ALL, 1.0)
            for t in range(8):
                lanes.edges(x, t, w, S)
                _judge(w)
            for k in range(count):
                i, h = np.uint64(k), begin + k
                shape[h] = min(3 / power_minus_two_thirds(w[_FULLEST + i]), 1.0)
                condition[h] = w[_CONDITION + i]


@parallel
def centre(points, hexes, jacobian):
    """Determinant of the Jacobian at the centre, det [X1, X2, X3] / 64 of the principal axes; writes jacobian (m,)."""
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, w = np.empty((8, 3)), np.empty((3, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load_from_first(points, hexes, h, x)
            _sum_axes(x, w)
            det = determinant(w[0, 0], w[0, 1], w[0, 2], w[1, 0], w[1, 1], w[1, 2], w[2, 0], w[2, 1], w[2, 2])
            jacobian[h] = det / 64
