"""Derivatives of one hex's energy: the plain loops over its corners.

Whole meshes are taken through `lanes`, several times faster; here are the reference for it and what is not hot.
"""

from __future__ import annotations

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.numba_kernels import serial, tetrahedron


@serial
def corner_edges(x, t):
    """The columns of S at corner tetrahedron t: edges from its apex; x is (8, 3)."""
    a, b, c, d = CORNER_TETRAHEDRA[t, 0], CORNER_TETRAHEDRA[t, 1], CORNER_TETRAHEDRA[t, 2], CORNER_TETRAHEDRA[t, 3]
    return (
        x[b, 0] - x[a, 0], x[b, 1] - x[a, 1], x[b, 2] - x[a, 2],
        x[c, 0] - x[a, 0], x[c, 1] - x[a, 1], x[c, 2] - x[a, 2],
        x[d, 0] - x[a, 0], x[d, 1] - x[a, 1], x[d, 2] - x[a, 2],
    )  # fmt: skip


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
def kept(left_out, t):
    """1 for a corner tetrahedron that counts, 0 for one whose bit is set in `left_out`."""
    return 1.0 - ((left_out >> t) & 1)


@serial
def left_out_count(left_out):
    """How many bits are set: as many tetrahedra count as perfect."""
    total = 0.0
    for t in range(8):
        total += (left_out >> t) & 1
    return total


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
def gradient(x, delta, left_out, g):
    """eta(H) before it is clamped at 0, and its gradient by the corners: (B.3), (B.20), (B.21).

    Parameters
    ----------
    x : (8, 3) float64
    delta : float
    left_out : int
        Bit t set: tetrahedron t counts as perfect.
    g : (8, 3) float64, written
    """
    g[:] = 0.0
    total = left_out_count(left_out)
    for t in range(8):
        ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
        eta, gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz = tetrahedron.gradient(
            ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, kept(left_out, t)
        )
        total += eta
        scatter(t, gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz, g)
    return total / 8 - 1


@serial
def product(x, v, delta, p, left_out, g, hv):
    """Hessian of max(eta(H), 0)^p times a displacement of the corners: (B.19) mended, (B.22), (C.1).

    Parameters
    ----------
    x, v : (8, 3) float64
        Corners and their displacements.
    delta, p : float
    left_out : int
        Bit t set: tetrahedron t counts as perfect.
    g : (8, 3) float64, written
        Gradient of eta(H).
    hv : (8, 3) float64, written
    """
    g[:] = 0.0
    hv[:] = 0.0
    total, slope = left_out_count(left_out), 0.0
    for t in range(8):
        ux, uy, uz, vx, vy, vz, wx, wy, wz = corner_edges(x, t)
        aux, auy, auz, avx, avy, avz, awx, awy, awz = corner_edges(v, t)
        (
            eta, along,
            gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz,
            hux, huy, huz, hvx, hvy, hvz, hwx, hwy, hwz,
        ) = tetrahedron.product(
            ux, uy, uz, vx, vy, vz, wx, wy, wz, aux, auy, auz, avx, avy, avz, awx, awy, awz, delta, kept(left_out, t)
        )  # fmt: skip
        total += eta
        slope += along
        scatter(t, gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz, g)
        scatter(t, hux, huy, huz, hvx, hvy, hvz, hwx, hwy, hwz, hv)
    first, second = weights(total / 8 - 1, p)
    for i in range(8):
        for j in range(3):
            hv[i, j] = first * hv[i, j] + second * slope * g[i, j]


@serial
def add_own(to, f, square, sigma, r, k, sx, sy, sz, cx, cy, cz):
    """Add `tetrahedron.own_second` to (6,)."""
    xx, xy, xz, yy, yz, zz = tetrahedron.own_second(f, square, sigma, r, k, sx, sy, sz, cx, cy, cz)
    to[0] += xx
    to[1] += xy
    to[2] += xz
    to[3] += yy
    to[4] += yz
    to[5] += zz
