"""Sum of eta(H)^p over a mesh: gradient, Hessian product and diagonal blocks, hex by hex.

Every hex writes its share into a block of its own; a node's row is the sum over the corners that meet there, always in
the same order, so that results do not depend on the number of threads.

Derivatives of eta(T) along V and W, directions of S, with C the cofactors of S (its columns e2 x e3, e3 x e1, e1 x e2,
so that d sigma(V) = (C, V)), r = sqrt(sigma^2 + 4 delta^2) and f = h^(-2/3)/3, so that eta = f |S|^2:

    d eta(V)    = 2 f [ (V, S) - |S|^2 (C, V)/(3 r) ]                                                       (B.3)
    d2 eta(V,W) = 2 f [ (V, W) - 2/(3 r) ((V, S)(C, W) + (C, V)(W, S))
                        - |S|^2/(3 r) d2 sigma(V, W) + |S|^2/(3 r^2) (2/3 + sigma/r) (C, V)(C, W) ]

The second is (B.19), mended, with (B.3) put in for d eta d eta/eta: the terms in 1/|S|^2 cancel, and nothing is divided
by eta, |S| or sigma, so that collapsed and inverted tetrahedra are no special case while delta > 0.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.kernels import CHUNK, parallel, serial
from hexmend.kernels.elements import corner_edges
from hexmend.kernels.shape import barrier, determinant, power_minus_two_thirds


@serial
def weights(energy, p):
    """First and second derivative of max(energy, 0)^p."""
    if energy < 0:
        return 0.0, 0.0
    if p == 2:
        return 2 * energy, 2.0
    if p == 1:
        return 1.0, 0.0
    if energy == 0:
        return 0.0, 0.0
    first = p * energy ** (p - 1)
    return first, (p - 1) * first / energy


@serial
def cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz):
    """Columns v x w, w x u, u x v: the derivative of the determinant of [u, v, w]."""
    return (
        vy * wz - vz * wy, vz * wx - vx * wz, vx * wy - vy * wx,
        wy * uz - wz * uy, wz * ux - wx * uz, wx * uy - wy * ux,
        uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx,
    )  # fmt: skip


@serial
def scatter(t, ux, uy, uz, vx, vy, vz, wx, wy, wz, to):
    """Add a derivative by the columns of S to the rows of the nodes that make them; `to` is (8, 3)."""
    a, b, c, d = CORNER_TETRAHEDRA[t, 0], CORNER_TETRAHEDRA[t, 1], CORNER_TETRAHEDRA[t, 2], CORNER_TETRAHEDRA[t, 3]
    to[b, 0] += ux
    to[b, 1] += uy
    to[b, 2] += uz
    to[c, 0] += vx
    to[c, 1] += vy
    to[c, 2] += vz
    to[d, 0] += wx
    to[d, 1] += wy
    to[d, 2] += wz
    to[a, 0] -= ux + vx + wx
    to[a, 1] -= uy + vy + wy
    to[a, 2] -= uz + vz + wz


@serial
def hex_gradient(x, delta, g):
    """eta(H) before it is clamped at 0, and its gradient by the corners: (B.3), (B.20), (B.21).

    Parameters
    ----------
    x : (8, 3) float64
    delta : float
    g : (8, 3) float64, written
    """
    g[:] = 0.0
    total = 0.0
    for t in range(8):
        ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
        cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        h, r = barrier(ux * cux + uy * cuy + uz * cuz, delta)
        square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
        f = power_minus_two_thirds(h) / 3
        total += f * square
        k, c = f / 4, f * square / (12 * r)  # (B.3), over 8
        scatter(
            t,
            k * ux - c * cux, k * uy - c * cuy, k * uz - c * cuz,
            k * vx - c * cvx, k * vy - c * cvy, k * vz - c * cvz,
            k * wx - c * cwx, k * wy - c * cwy, k * wz - c * cwz,
            g,
        )  # fmt: skip
    return total / 8 - 1


@serial
def hex_product(x, v, delta, p, g, hv):
    """Hessian of max(eta(H), 0)^p times a displacement of the corners: (B.19) mended, (B.22), (C.1).

    Parameters
    ----------
    x, v : (8, 3) float64
        Corners and their displacements.
    delta, p : float
    g : (8, 3) float64, written
        Gradient of eta(H).
    hv : (8, 3) float64, written
    """
    g[:] = 0.0
    hv[:] = 0.0
    total, slope = 0.0, 0.0
    for t in range(8):
        ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
        aux, auy, auz, avx, avy, avz, awx, awy, awz = corner_edges(v, t)
        cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        sigma = ux * cux + uy * cuy + uz * cuz
        h, r = barrier(sigma, delta)
        square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
        f = power_minus_two_thirds(h) / 3
        total += f * square
        along_s = aux * ux + auy * uy + auz * uz + avx * vx + avy * vy + avz * vz + awx * wx + awy * wy + awz * wz
        along_c = aux * cux + auy * cuy + auz * cuz + avx * cvx + avy * cvy + avz * cvz
        along_c += awx * cwx + awy * cwy + awz * cwz  # d sigma
        k, c = f / 4, f * square / (12 * r)
        slope += k * along_s - c * along_c  # (B.3), over 8
        scatter(
            t,
            k * ux - c * cux, k * uy - c * cuy, k * uz - c * cuz,
            k * vx - c * cvx, k * vy - c * cvy, k * vz - c * cvz,
            k * wx - c * cwx, k * wy - c * cwy, k * wz - c * cwz,
            g,
        )  # fmt: skip
        # d2 eta(V, .), over 8: what multiplies S and C; V itself comes with k, dC with -c.
        s = -2 * k / (3 * r) * along_c
        q = -2 * k / (3 * r) * along_s + c / r * (2.0 / 3.0 + sigma / r) * along_c
        # dC: its columns are dv x w + v x dw, and so on round.
        dux, duy, duz = (
            avy * wz - avz * wy + vy * awz - vz * awy,
            avz * wx - avx * wz + vz * awx - vx * awz,
            avx * wy - avy * wx + vx * awy - vy * awx,
        )
        dvx, dvy, dvz = (
            awy * uz - awz * uy + wy * auz - wz * auy,
            awz * ux - awx * uz + wz * aux - wx * auz,
            awx * uy - awy * ux + wx * auy - wy * aux,
        )
        dwx, dwy, dwz = (
            auy * vz - auz * vy + uy * avz - uz * avy,
            auz * vx - aux * vz + uz * avx - ux * avz,
            aux * vy - auy * vx + ux * avy - uy * avx,
        )
        scatter(
            t,
            s * ux + q * cux + k * aux - c * dux,
            s * uy + q * cuy + k * auy - c * duy,
            s * uz + q * cuz + k * auz - c * duz,
            s * vx + q * cvx + k * avx - c * dvx,
            s * vy + q * cvy + k * avy - c * dvy,
            s * vz + q * cvz + k * avz - c * dvz,
            s * wx + q * cwx + k * awx - c * dwx,
            s * wy + q * cwy + k * awy - c * dwy,
            s * wz + q * cwz + k * awz - c * dwz,
            hv,
        )
    first, second = weights(total / 8 - 1, p)
    for i in range(8):
        for j in range(3):
            hv[i, j] = first * hv[i, j] + second * slope * g[i, j]


@serial
def _corners_of(values, hexes, h, x):
    for c in range(8):
        for k in range(3):
            x[c, k] = values[hexes[h, c], k]


@serial
def _displacements_of(values, slots, h, v):
    for c in range(8):
        i = slots[h, c]
        for k in range(3):
            v[c, k] = values[i, k] if i >= 0 else 0.0


@parallel
def gradient(points, hexes, delta, p, blocks):
    """Gradient of sum eta(H)^p by the corners of every hex; writes blocks (m, 8, 3).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta, p : float
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, g = np.empty((8, 3)), np.empty((8, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            _corners_of(points, hexes, h, x)
            first, _ = weights(hex_gradient(x, delta, g), p)
            for i in range(8):
                for j in range(3):
                    blocks[h, i, j] = first * g[i, j]


@parallel
def hessian_product(points, hexes, slots, values, delta, p, blocks):
    """Hessian of sum eta(H)^p times a displacement of the free nodes; writes blocks (m, 8, 3).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    slots : (m, 8) int32
        Number of each corner among the free nodes, -1 if it is fixed.
    values : (free nodes, 3) float64
    delta, p : float
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, v, g, hv = np.empty((8, 3)), np.empty((8, 3)), np.empty((8, 3)), np.empty((8, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            _corners_of(points, hexes, h, x)
            _displacements_of(values, slots, h, v)
            hex_product(x, v, delta, p, g, hv)
            blocks[h] = hv


@parallel
def hex_hessians(points, hexes, delta, p, first, blocks):
    """Hessian of eta(H)^p of the hexes first, first + 1, ... by their corners; writes blocks (count, 24, 24)."""
    for k in numba.prange(blocks.shape[0]):
        x, v, g, hv = np.empty((8, 3)), np.zeros((8, 3)), np.empty((8, 3)), np.empty((8, 3))
        _corners_of(points, hexes, first + k, x)
        for j in range(24):
            v[j // 3, j % 3] = 1.0
            hex_product(x, v, delta, p, g, hv)
            v[j // 3, j % 3] = 0.0
            for i in range(24):
                blocks[k, i, j] = hv[i // 3, i % 3]


@parallel
def diagonal_blocks(points, hexes, delta, p, blocks):
    """The 3 x 3 blocks of the Hessian that couple a corner with itself; writes blocks (m, 8, 6): xx xy xz yy yz zz."""
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, g, own = np.empty((8, 3)), np.empty((8, 3)), np.empty((8, 6))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            _corners_of(points, hexes, h, x)
            first, second = weights(hex_gradient(x, delta, g), p)
            own[:] = 0.0
            for t in range(8):
                ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
                sigma = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
                cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
                h_sigma, r = barrier(sigma, delta)
                square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
                f = power_minus_two_thirds(h_sigma) / 3
                a, b, c, d = (
                    CORNER_TETRAHEDRA[t, 0],
                    CORNER_TETRAHEDRA[t, 1],
                    CORNER_TETRAHEDRA[t, 2],
                    CORNER_TETRAHEDRA[t, 3],
                )
                add_own(own[b], f, square, sigma, r, 1.0, ux, uy, uz, cux, cuy, cuz)
                add_own(own[c], f, square, sigma, r, 1.0, vx, vy, vz, cvx, cvy, cvz)
                add_own(own[d], f, square, sigma, r, 1.0, wx, wy, wz, cwx, cwy, cwz)
                add_own(
                    own[a], f, square, sigma, r, 3.0,
                    -(ux + vx + wx), -(uy + vy + wy), -(uz + vz + wz),
                    -(cux + cvx + cwx), -(cuy + cvy + cwy), -(cuz + cvz + cwz),
                )  # fmt: skip
            for i in range(8):
                gx, gy, gz = g[i, 0], g[i, 1], g[i, 2]
                blocks[h, i, 0] = first * own[i, 0] / 8 + second * gx * gx
                blocks[h, i, 1] = first * own[i, 1] / 8 + second * gx * gy
                blocks[h, i, 2] = first * own[i, 2] / 8 + second * gx * gz
                blocks[h, i, 3] = first * own[i, 3] / 8 + second * gy * gy
                blocks[h, i, 4] = first * own[i, 4] / 8 + second * gy * gz
                blocks[h, i, 5] = first * own[i, 5] / 8 + second * gz * gz


@serial
def add_own(to, f, square, sigma, r, k, sx, sy, sz, cx, cy, cz):
    """Add the second derivatives of eta(T) by one of its nodes, where d2 sigma vanishes (B.1), to (xx xy xz yy yz zz).

    Parameters
    ----------
    k : float
        (V, V) of a unit displacement: 3 of the apex, 1 of the others.
    sx, sy, sz, cx, cy, cz : float
        (V, S) and (C, V) of the unit displacements along x, y, z.
    """
    a = 4 * f / (3 * r)
    b = 2 * f * square / (3 * r * r) * (2.0 / 3.0 + sigma / r)
    to[0] += 2 * f * k - 2 * a * sx * cx + b * cx * cx
    to[1] += -a * (sx * cy + sy * cx) + b * cx * cy
    to[2] += -a * (sx * cz + sz * cx) + b * cx * cz
    to[3] += 2 * f * k - 2 * a * sy * cy + b * cy * cy
    to[4] += -a * (sy * cz + sz * cy) + b * cy * cz
    to[5] += 2 * f * k - 2 * a * sz * cz + b * cz * cz


@parallel
def gather(blocks, start, corners, nodes, rows):
    """Sum over the corners at each of `nodes`; writes rows (nodes, width) from blocks (8 m, width)."""
    for k in numba.prange(nodes.size):
        i = nodes[k]
        for j in range(rows.shape[1]):
            total = 0.0
            for s in range(start[i], start[i + 1]):
                total += blocks[corners[s], j]
            rows[k, j] = total
