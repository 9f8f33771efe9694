"""GETMe's element step: a hex grows more regular by itself.

Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and outward normal of the triangle that the centroids of the three
faces at k make in the dual octahedron; the hex is scaled about its centroid to its old mean edge length and blended
with the old one by rho. Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import EDGES, FACES, UNIT_CUBE
from hexmend.numba_kernels import formula, lanes, parallel, serial
from hexmend.numba_kernels.lanes import ALL, CHUNK, CORNERS, LANES, ROW, STRIDE, VECTOR, WORK, vector


def _corner_faces() -> np.ndarray:
    side = UNIT_CUBE.astype(np.int64)
    faces = side + [0, 2, 4]  # FACES is x-, x+, y-, y+, z-, z+
    mirrored = side.sum(axis=1) % 2 == 0
    faces[mirrored, 1:] = faces[mirrored, :0:-1]
    return faces


#: The three faces (i, j, k) that meet at each corner, (8, 3): the normal of their centroids' triangle points outward.
CORNER_FACES = _corner_faces()


@formula
def _corner(ax, ay, az, bx, by, bz, cx, cy, cz, s):
    """c_k + s n_k/sqrt(|n_k|) of the triangle a, b, c."""
    ux, uy, uz = bx - ax, by - ay, bz - az
    vx, vy, vz = cx - ax, cy - ay, cz - az
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    root = np.sqrt(np.sqrt(nx * nx + ny * ny + nz * nz))
    along = s / root if root > 0 else 0.0
    third = 1.0 / 3.0
    return (ax + bx + cx) * third + along * nx, (ay + by + cy) * third + along * ny, (az + bz + cz) * third + along * nz


@serial
def _mean_edge(x):
    total = 0.0
    for e in range(12):
        a, b = EDGES[e, 0], EDGES[e, 1]
        dx, dy, dz = x[b, 0] - x[a, 0], x[b, 1] - x[a, 1], x[b, 2] - x[a, 2]
        total += np.sqrt(dx * dx + dy * dy + dz * dz)
    return total / 12


@serial
def element_step(x, s, rho, f, y):
    """One hex x (8, 3) after the step; writes y (8, 3), uses f (6, 3)."""
    for i in range(6):
        for k in range(3):
            f[i, k] = (x[FACES[i, 0], k] + x[FACES[i, 1], k] + x[FACES[i, 2], k] + x[FACES[i, 3], k]) / 4
    mx, my, mz = 0.0, 0.0, 0.0
    for c in range(8):
        i, j, k = CORNER_FACES[c, 0], CORNER_FACES[c, 1], CORNER_FACES[c, 2]
        y[c, 0], y[c, 1], y[c, 2] = _corner(
            f[i, 0], f[i, 1], f[i, 2], f[j, 0], f[j, 1], f[j, 2], f[k, 0], f[k, 1], f[k, 2], s
        )
        mx += y[c, 0] / 8
        my += y[c, 1] / 8
        mz += y[c, 2] / 8
    length = _mean_edge(y)
    zeta = _mean_edge(x) / length if length > 0 else 0.0
    for c in range(8):
        y[c, 0] = x[c, 0] + rho * (mx + zeta * (y[c, 0] - mx) - x[c, 0])
        y[c, 1] = x[c, 1] + rho * (my + zeta * (y[c, 1] - my) - x[c, 1])
        y[c, 2] = x[c, 2] + rho * (mz + zeta * (y[c, 2] - mz) - x[c, 2])


# The same for a block of hexes side by side, as `lanes` explains. Vectors of work beside a triangle's three: the new
# corner, the centroid; then rows of the sums of edge lengths before and after, in the place of which, in the end, three
# rows of zeta come.
_NEW, _CENTROID, _ZETA = ROW[9], ROW[12], ROW[15]
_BEFORE, _AFTER = ROW[15], ROW[16]


@serial
def _faces(x, f):
    """Centroids of the six faces, f (18 rows)."""
    for face in range(6):
        a, b, c, d = vector(FACES[face, 0]), vector(FACES[face, 1]), vector(FACES[face, 2]), vector(FACES[face, 3])
        to = vector(face)
        for i in range(VECTOR):
            f[to + i] = (x[a + i] + x[b + i] + x[c + i] + x[d + i]) * 0.25


@serial
def _add_edges(x, w, to):
    """Lengths of the twelve edges, added to a row of work."""
    for e in range(12):
        a, b = vector(EDGES[e, 0]), vector(EDGES[e, 1])
        for i in range(ALL):
            dx, dy, dz = (
                x[b + i] - x[a + i],
                x[b + ROW[1] + i] - x[a + ROW[1] + i],
                x[b + ROW[2] + i] - x[a + ROW[2] + i],
            )
            w[to + i] += np.sqrt(dx * dx + dy * dy + dz * dz)


@serial
def _triangle(w, s):
    """`_corner` of the triangle in the first nine rows of work."""
    for i in range(ALL):
        x, y, z = _corner(
            w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i],
            w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i],
            w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i], s,
        )  # fmt: skip
        w[ROW[9] + i], w[ROW[10] + i], w[ROW[11] + i] = x, y, z
        w[ROW[12] + i] += x * 0.125
        w[ROW[13] + i] += y * 0.125
        w[ROW[14] + i] += z * 0.125


@serial
def _blend(x, w, rho, y):
    """Scale the new hexes y and blend them with the old ones."""
    for i in range(ALL):
        before, after = w[_BEFORE + i], w[_AFTER + i]
        zeta = before / after if after > 0 else 0.0
        w[ROW[15] + i], w[ROW[16] + i], w[ROW[17] + i] = zeta, zeta, zeta
    for c in range(8):
        corner = vector(c)
        for i in range(VECTOR):
            middle = w[_CENTROID + i]
            there = middle + w[_ZETA + i] * (y[corner + i] - middle)
            y[corner + i] = x[corner + i] + rho * (there - x[corner + i])


@parallel
def element_steps(points, hexes, s, rho, places):
    """`element_step` of every hex; writes places (m, 8, 3)."""
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, y, f, w = np.empty(CORNERS), np.empty(CORNERS), np.empty(18 * STRIDE), np.empty(WORK)
        end = min(m, (chunk + 1) * CHUNK)
        for begin in range(chunk * CHUNK, end, LANES):
            count = min(LANES, end - begin)
            lanes.load(points, hexes, begin, count, x)
            _faces(x, f)
            lanes.fill(w, 0, WORK, 0.0)
            for c in range(8):
                for j in range(3):
                    lanes.copy(f, vector(CORNER_FACES[c, j]), w, vector(j))
                _triangle(w, s)
                lanes.copy(w, _NEW, y, vector(c))
            _add_edges(x, w, _BEFORE)
            _add_edges(y, w, _AFTER)
            _blend(x, w, rho, y)
            for i in range(count):
                for c in range(8):
                    for k in range(3):
                        places[begin + i, c, k] = y[(3 * c + k) * STRIDE + i]
