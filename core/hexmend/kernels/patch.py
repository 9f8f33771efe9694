"""The energy of a node's patch as a function of that node alone.

Each attached hex has four corner tetrahedra that hold the node: the one whose apex it is, and those of its three edge
neighbours. The other four do not change as the node moves. At the node's displacement y,

    sigma = sigma_0 + g . y          |S|^2 = s_0 + b . y + k |y|^2,   k = 3 at the apex, else 1,

because a determinant is linear in each of its columns. A patch is therefore a table of numbers a tetrahedron, made once
a visit, on which value, gradient and every trial of the line search are short loops over lanes.
"""

from __future__ import annotations

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA, EDGES
from hexmend.kernels import serial
from hexmend.kernels.hexahedron import add_own, corner_edges, weights
from hexmend.kernels.shape import TINY, barrier, determinant, power_minus_two_thirds

#: Columns of a patch table.
SIGMA, GX, GY, GZ, SQUARE, BX, BY, BZ, K = range(9)


def _around(corner: int) -> list[list[int]]:
    """The tetrahedra that hold a corner, as (apex, others in cyclic order); a neighbour's others begin with it."""
    rows = [list(CORNER_TETRAHEDRA[corner])]
    for apex, *others in CORNER_TETRAHEDRA:
        if corner in others:
            turn = others.index(corner)
            rows.append([apex, *others[turn:], *others[:turn]])
    return rows


#: Of each corner: its own tetrahedron, then three (apex, corner, u, v); (8, 4, 4).
AROUND = np.array([_around(c) for c in range(8)], dtype=np.int64)
#: Of each corner: the rows of CORNER_TETRAHEDRA that do not hold it, (8, 4).
APART = np.array([[t for t in range(8) if c not in CORNER_TETRAHEDRA[t]] for c in range(8)], dtype=np.int64)


@serial
def scale_of(points, hexes, corners, begin, end):
    """One over the mean edge length of a patch, each edge counted once a hex; 0 if the patch has no extent."""
    total = 0.0
    for s in range(begin, end):
        h = corners[s] // 8
        for e in range(12):
            a, b = hexes[h, EDGES[e, 0]], hexes[h, EDGES[e, 1]]
            dx, dy, dz = points[a, 0] - points[b, 0], points[a, 1] - points[b, 1], points[a, 2] - points[b, 2]
            total += np.sqrt(dx * dx + dy * dy + dz * dz)
    return 12 * (end - begin) / total if total > 0 else 0.0


@serial
def tabulate(points, hexes, corners, begin, end, scale, delta, x, table, rest):
    """Write a patch's table.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    corners : (8 m,) int32
        8 * hex + corner; the patch's are corners[begin:end], its node being the same for all.
    scale : float
        Lengths are multiplied by it, (3.2)'s delta being meant for edges of mean length 1.
    delta : float
    x : (8, 3) float64, scratch
    table : (9, 4 * hexes of the patch or more) float64, written
        sigma_0, g, s_0, b, k of each tetrahedron that holds the node, four a hex.
    rest : (hexes of the patch or more,) float64, written
        Sum of eta over the four tetrahedra of each hex that do not hold it.
    """
    node = hexes[corners[begin] // 8, corners[begin] % 8]
    ox, oy, oz = points[node, 0], points[node, 1], points[node, 2]
    for s in range(begin, end):
        h, corner = corners[s] // 8, corners[s] % 8
        for c in range(8):
            i = hexes[h, c]
            x[c, 0] = (points[i, 0] - ox) * scale
            x[c, 1] = (points[i, 1] - oy) * scale
            x[c, 2] = (points[i, 2] - oz) * scale
        row = 4 * (s - begin)
        # The node's own tetrahedron: S = [u - y, v - y, w - y].
        u, v, w = AROUND[corner, 0, 1], AROUND[corner, 0, 2], AROUND[corner, 0, 3]
        ux, uy, uz = x[u, 0], x[u, 1], x[u, 2]
        vx, vy, vz = x[v, 0], x[v, 1], x[v, 2]
        wx, wy, wz = x[w, 0], x[w, 1], x[w, 2]
        table[SIGMA, row] = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        table[GX, row] = -((vy * wz - vz * wy) + (wy * uz - wz * uy) + (uy * vz - uz * vy))
        table[GY, row] = -((vz * wx - vx * wz) + (wz * ux - wx * uz) + (uz * vx - ux * vz))
        table[GZ, row] = -((vx * wy - vy * wx) + (wx * uy - wy * ux) + (ux * vy - uy * vx))
        table[SQUARE, row] = (
            ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
        )  # fmt: skip
        table[BX, row] = -2 * (ux + vx + wx)
        table[BY, row] = -2 * (uy + vy + wy)
        table[BZ, row] = -2 * (uz + vz + wz)
        table[K, row] = 3.0
        # Its neighbours' tetrahedra: S = [y - a, u - a, v - a].
        for j in range(1, 4):
            a, u, v = AROUND[corner, j, 0], AROUND[corner, j, 2], AROUND[corner, j, 3]
            ax, ay, az = x[a, 0], x[a, 1], x[a, 2]
            ux, uy, uz = x[u, 0] - ax, x[u, 1] - ay, x[u, 2] - az
            vx, vy, vz = x[v, 0] - ax, x[v, 1] - ay, x[v, 2] - az
            gx, gy, gz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            table[SIGMA, row + j] = -(ax * gx + ay * gy + az * gz)
            table[GX, row + j] = gx
            table[GY, row + j] = gy
            table[GZ, row + j] = gz
            table[SQUARE, row + j] = (
                ax * ax + ay * ay + az * az + ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz
            )  # fmt: skip
            table[BX, row + j] = -2 * ax
            table[BY, row + j] = -2 * ay
            table[BZ, row + j] = -2 * az
            table[K, row + j] = 1.0
        total = 0.0
        for j in range(4):
            ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, APART[corner, j])
            det = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
            square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
            total += square * power_minus_two_thirds(barrier(det, delta)[0]) / 3
        rest[s - begin] = total


@serial
def lanes(table, count, y0, y1, y2, delta, lane):
    """eta(T) of the patch's first `count` tetrahedra with the node displaced by y.

    Two short loops without a branch or a call, so that the compiler runs them over vectors.

    Parameters
    ----------
    lane : (2, count or more) float64, written
        Row 0 holds eta, row 1 h.
    """
    eta, h = lane[0], lane[1]
    softness = 4 * delta * delta
    far = y0 * y0 + y1 * y1 + y2 * y2
    for t in range(count):
        sigma = table[SIGMA, t] + table[GX, t] * y0 + table[GY, t] * y1 + table[GZ, t] * y2
        square = table[SQUARE, t] + table[BX, t] * y0 + table[BY, t] * y1 + table[BZ, t] * y2 + table[K, t] * far
        u = abs(sigma) + np.sqrt(sigma * sigma + softness)
        h[t] = 0.5 * u if sigma >= 0 else 0.5 * softness / max(u, TINY)  # (3.2)
        eta[t] = square * (1.0 / 3.0)
    for t in range(count):
        eta[t] *= power_minus_two_thirds(h[t])  # (3.1)


@serial
def value(table, rest, size, y0, y1, y2, delta, p, lane):
    """Sum over the patch's hexes of eta(H)^p with the node displaced by y: (3.3) without its root, (B.20)."""
    lanes(table, 4 * size, y0, y1, y2, delta, lane)
    eta = lane[0]
    total = 0.0
    for s in range(size):
        energy = (eta[4 * s] + eta[4 * s + 1] + eta[4 * s + 2] + eta[4 * s + 3] + rest[s]) / 8 - 1
        energy = max(energy, 0.0)
        total += energy * energy if p == 2 else energy**p
    return total


@serial
def value_and_gradient(table, rest, size, delta, p, lane):
    """Value where the node is, and its gradient: (B.3), (B.21), (C.1)."""
    lanes(table, 4 * size, 0.0, 0.0, 0.0, delta, lane)
    eta = lane[0]
    total, gx, gy, gz = 0.0, 0.0, 0.0, 0.0
    for s in range(size):
        energy, ex, ey, ez = hex_gradient(table, rest, s, delta, eta)
        first, _ = weights(energy, p)
        energy = max(energy, 0.0)  # softened by delta, a hex better than perfect counts as perfect
        total += energy * energy if p == 2 else energy**p
        gx += first * ex
        gy += first * ey
        gz += first * ez
    return total, gx, gy, gz


@serial
def hex_gradient(table, rest, s, delta, eta):
    """eta(H) of the patch's hex s and its gradient by the node, from the eta(T) that `lanes` wrote."""
    energy, ex, ey, ez = rest[s], 0.0, 0.0, 0.0
    for t in range(4 * s, 4 * s + 4):
        # d eta = 2 eta [ (dS, S)/|S|^2 - d sigma/(3 r) ]
        r = np.sqrt(table[SIGMA, t] ** 2 + 4 * delta * delta)
        stretch, squeeze = eta[t] / table[SQUARE, t], 2 * eta[t] / (3 * r)
        ex += stretch * table[BX, t] - squeeze * table[GX, t]
        ey += stretch * table[BY, t] - squeeze * table[GY, t]
        ez += stretch * table[BZ, t] - squeeze * table[GZ, t]
        energy += eta[t]
    return energy / 8 - 1, ex / 8, ey / 8, ez / 8


@serial
def hessian(table, rest, size, delta, p, eta, own):
    """Second derivatives of the value where the node is, (xx xy xz yy yz zz): (B.19) mended, (B.22).

    Parameters
    ----------
    eta : (4 * size or more,) float64
        Row 0 of `lane` as `value_and_gradient` left it.
    own : (6,) float64, scratch
    """
    xx, xy, xz, yy, yz, zz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for s in range(size):
        energy, ex, ey, ez = hex_gradient(table, rest, s, delta, eta)
        first, second = weights(energy, p)
        own[:] = 0.0
        for t in range(4 * s, 4 * s + 4):
            sigma, square = table[SIGMA, t], table[SQUARE, t]
            r = np.sqrt(sigma * sigma + 4 * delta * delta)
            add_own(
                own, eta[t] / square, square, sigma, r, table[K, t],
                table[BX, t] / 2, table[BY, t] / 2, table[BZ, t] / 2,
                table[GX, t], table[GY, t], table[GZ, t],
            )  # fmt: skip
        xx += first * own[0] / 8 + second * ex * ex
        xy += first * own[1] / 8 + second * ex * ey
        xz += first * own[2] / 8 + second * ex * ez
        yy += first * own[3] / 8 + second * ey * ey
        yz += first * own[4] / 8 + second * ey * ez
        zz += first * own[5] / 8 + second * ez * ez
    return xx, xy, xz, yy, yz, zz
