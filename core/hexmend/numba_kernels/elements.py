"""Figures of every hex in one pass over its eight corner tetrahedra."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import lanes, parallel, serial
from hexmend.numba_kernels.hexahedron import corner_edges
from hexmend.numba_kernels.lanes import ALL, CHUNK, CORNERS, LANES, ROW, SUM, WORK, S
from hexmend.numba_kernels.shape import determinant, power_minus_two_thirds


@serial
def load(points, hexes, h, x):
    """Write the corners of hex h into x (8, 3)."""
    for c in range(8):
        for k in range(3):
            x[c, k] = points[hexes[h, c], k]


@serial
def quality(x):
    """q(H) of the hex with corners x (8, 3), (2.10), and whether none of its corners is inverted."""
    total, sound = 0.0, True
    for t in range(8):
        ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
        det = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        if det > 0:
            square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
            total += 3 / (square * power_minus_two_thirds(det))
        else:
            sound = False
    return total / 8, sound


#: Rows in which `measure` keeps, beside the sum of eta, the sum of q, the least determinant and scaled Jacobian.
_Q, _LOWEST, _WORST = ROW[9], ROW[10], ROW[11]


@serial
def _judge(w):
    """Take the tetrahedra in S into the sums and minima of their hexes."""
    for i in range(ALL):
        ux, uy, uz = w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i]
        vx, vy, vz = w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i]
        wx, wy, wz = w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i]
        det = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        u2 = ux * ux + uy * uy + uz * uz
        v2 = vx * vx + vy * vy + vz * vz
        w2 = wx * wx + wy * wy + wz * wz
        shape = (u2 + v2 + w2) * power_minus_two_thirds(det) * (1.0 / 3.0)  # eta(T), (3.1)
        w[SUM + i] += shape if det > 0 else np.inf
        w[_Q + i] += 1 / shape if det > 0 else 0.0  # (2.8)
        lengths = np.sqrt(u2) * np.sqrt(v2) * np.sqrt(w2)
        jacobian = det / lengths if lengths > 0 else 0.0
        w[_LOWEST + i] = min(w[_LOWEST + i], det)
        w[_WORST + i] = min(w[_WORST + i], jacobian)


@parallel
def measure(points, hexes, q, sigma, jacobian, eta):
    """Quality of every hex at delta = 0.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    q : (m,) float64, written
        q(H), the mean of q(T) = 3 sigma^(2/3)/|S|^2, 0 where sigma <= 0: (2.8), (2.10).
    sigma : (m,) float64, written
        The least of the eight corner determinants, (2.9).
    jacobian : (m,) float64, written
        Scaled Jacobian: the least of sigma/(|e1||e2||e3|); 0 at a corner with an edge of no length.
    eta : (m,) float64, written
        eta(H) = mean of eta(T) - 1, (B.20); +inf where sigma <= 0.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, w = np.empty(CORNERS), np.empty(WORK)
        end = min(m, (chunk + 1) * CHUNK)
        for begin in range(chunk * CHUNK, end, LANES):
            count = min(LANES, end - begin)
            lanes.load(points, hexes, begin, count, x)
            lanes.fill(w, SUM, SUM + ALL, 0.0)
            lanes.fill(w, _Q, _Q + ALL, 0.0)
            lanes.fill(w, _LOWEST, _LOWEST + ALL, np.inf)
            lanes.fill(w, _WORST, _WORST + ALL, np.inf)
            for t in range(8):
                lanes.edges(x, t, w, S)
                _judge(w)
            for k in range(count):
                i, h = np.uint64(k), begin + k
                q[h] = w[_Q + i] / 8
                sigma[h] = w[_LOWEST + i]
                jacobian[h] = w[_WORST + i]
                eta[h] = max(w[SUM + i] / 8 - 1, 0.0)


@parallel
def corner_determinants(points, hexes, which, sigma):
    """sigma of the eight corner tetrahedra, (2.9), of the hexes `which` (k,); writes sigma (k, 8)."""
    for chunk in numba.prange((which.size + CHUNK - 1) // CHUNK):
        x = np.empty((8, 3))
        for i in range(chunk * CHUNK, min(which.size, (chunk + 1) * CHUNK)):
            load(points, hexes, which[i], x)
            for t in range(8):
                ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
                sigma[i, t] = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
