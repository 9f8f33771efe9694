"""Metrics of every hex by its six faces: angles, warpage, and the volume that they enclose."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import FACES
from hexmend.numba_kernels import CHUNK, lanes, parallel, serial
from hexmend.numba_kernels.elements import load
from hexmend.numba_kernels.lanes import ALL, CORNERS, LANES, ROW, WORK, S
from hexmend.numba_kernels.metrics import load_from_first

#: Rows in which `angles` keeps the least and the greatest cosine of each hex.
_LEAST, _GREATEST = ROW[9], ROW[10]


@serial
def _judge(w):
    """Take the angles of the tetrahedra in S at their apex into the extremes of their hexes.

    An edge of no length makes every angle: -1 and 1.
    """
    for i in range(ALL):
        ux, uy, uz = w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i]
        vx, vy, vz = w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i]
        wx, wy, wz = w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i]
        a = np.sqrt(ux * ux + uy * uy + uz * uz)
        b = np.sqrt(vx * vx + vy * vy + vz * vz)
        c = np.sqrt(wx * wx + wy * wy + wz * wz)
        product = a * b * c
        sound = (product > 0) & (product < np.inf)
        one = 1 / product if sound else 0.0
        uv = (ux * vx + uy * vy + uz * vz) * c * one
        vw = (vx * wx + vy * wy + vz * wz) * a * one
        wu = (wx * ux + wy * uy + wz * uz) * b * one
        w[_LEAST + i] = min(w[_LEAST + i], uv, vw, wu) if sound else -1.0
        w[_GREATEST + i] = max(w[_GREATEST + i], uv, vw, wu) if sound else 1.0


@parallel
def angles(points, hexes, smallest, largest):
    """Angles between adjacent edges of the faces, four corners of six faces.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    smallest, largest : (m,) float64, written
        In degrees; 0 and 180 where an edge has no length.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + lanes.CHUNK - 1) // lanes.CHUNK):
        x, w = np.empty(CORNERS), np.empty(WORK)
        end = min(m, (chunk + 1) * lanes.CHUNK)
        for begin in range(chunk * lanes.CHUNK, end, LANES):
            count = min(LANES, end - begin)
            lanes.load(points, hexes, begin, count, x)
            lanes.fill(w, _LEAST, _LEAST + ALL, 1.0)
            lanes.fill(w, _GREATEST, _GREATEST + ALL, -1.0)
            for t in range(8):
                lanes.edges(x, t, w, S)
                _judge(w)
            for k in range(count):
                i, h = np.uint64(k), begin + k
                smallest[h] = np.arccos(min(w[_GREATEST + i], 1.0)) * (180 / np.pi)
                largest[h] = np.arccos(max(w[_LEAST + i], -1.0)) * (180 / np.pi)


@serial
def _cosine(ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz):
    """Cosine of the angle of a x b and c x d; -1 where one of them has no length."""
    mx, my, mz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    nx, ny, nz = cy * dz - cz * dy, cz * dx - cx * dz, cx * dy - cy * dx
    product = np.sqrt(mx * mx + my * my + mz * mz) * np.sqrt(nx * nx + ny * ny + nz * nz)
    return (mx * nx + my * ny + mz * nz) / product if 0 < product < np.inf else -1.0


@serial
def _warpage(x):
    """Warpage of the hex with corners x (8, 3)."""
    least = 1.0
    for f in range(6):
        a, b, c, d = FACES[f, 0], FACES[f, 1], FACES[f, 2], FACES[f, 3]
        px, py, pz = x[b, 0] - x[a, 0], x[b, 1] - x[a, 1], x[b, 2] - x[a, 2]
        qx, qy, qz = x[c, 0] - x[b, 0], x[c, 1] - x[b, 1], x[c, 2] - x[b, 2]
        rx, ry, rz = x[d, 0] - x[c, 0], x[d, 1] - x[c, 1], x[d, 2] - x[c, 2]
        sx, sy, sz = x[a, 0] - x[d, 0], x[a, 1] - x[d, 1], x[a, 2] - x[d, 2]
        least = min(
            least,
            _cosine(sx, sy, sz, px, py, pz, qx, qy, qz, rx, ry, rz),
            _cosine(px, py, pz, qx, qy, qz, rx, ry, rz, sx, sy, sz),
        )
    least = max(least, -1.0)
    return 1 - least * least * least


@parallel
def warpage(points, hexes, worst):
    """Warpage of the worst face.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    worst : (m,) float64, written
        Greatest over the faces of 1 - min((n0 . n2)^3, (n1 . n3)^3), n the unit normals at the face's corners; 2 where
        a corner of a face has no normal.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x = np.empty((8, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load(points, hexes, h, x)
            worst[h] = _warpage(x)


@serial
def _volume(x):
    """Volume of the hex with corners x (8, 3): of a face a, b, c, d, (a + b + c + d) . (c - a) x (d - b) / 24."""
    total = 0.0
    for f in range(6):
        a, b, c, d = FACES[f, 0], FACES[f, 1], FACES[f, 2], FACES[f, 3]
        ux, uy, uz = x[c, 0] - x[a, 0], x[c, 1] - x[a, 1], x[c, 2] - x[a, 2]
        vx, vy, vz = x[d, 0] - x[b, 0], x[d, 1] - x[b, 1], x[d, 2] - x[b, 2]
        total += (
            (x[a, 0] + x[b, 0] + x[c, 0] + x[d, 0]) * (uy * vz - uz * vy)
            + (x[a, 1] + x[b, 1] + x[c, 1] + x[d, 1]) * (uz * vx - ux * vz)
            + (x[a, 2] + x[b, 2] + x[c, 2] + x[d, 2]) * (ux * vy - uy * vx)
        )
    return total / 24


@parallel
def volume(points, hexes, enclosed):
    """Volume inside the six bilinear faces, that of Verdict's 24 tetrahedra: negative for a hex turned inside out.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    enclosed : (m,) float64, written
        In the cube of the mesh's unit of length.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x = np.empty((8, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load_from_first(points, hexes, h, x)
            enclosed[h] = _volume(x)
