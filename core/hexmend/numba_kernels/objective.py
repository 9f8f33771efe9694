"""Sum of eta(H)^p over a mesh: energies, gradient, Hessian product.

Every hex writes its share into a block of its own; a node's row is the sum over the corners that meet there, always in
the same order, so that results do not depend on the number of threads.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import parallel, serial, tetrahedron
from hexmend.numba_kernels.hexahedron import weights
from hexmend.numba_kernels.lanes import (
    ALL,
    CHUNK,
    CORNERS,
    KEEP,
    LANES,
    ROW,
    SLOPE,
    STRIDE,
    SUM,
    WORK,
    A,
    G,
    H,
    S,
    edges,
    fill,
    load,
    scatter,
    select,
    start_sums,
)


@serial
def _add_energies(w, delta):
    """eta(T) of the tetrahedra in S, added to SUM."""
    for i in range(ALL):
        f, square, _, _ = tetrahedron.energy(
            w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i],
            w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i],
            w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i], delta, w[KEEP + i],
        )  # fmt: skip
        w[SUM + i] += f * square


@serial
def _gradients(w, delta):
    """eta(T) of the tetrahedra in S, added to SUM, and their derivatives, written to G."""
    for i in range(ALL):
        eta, gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz = tetrahedron.gradient(
            w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i],
            w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i],
            w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i], delta, w[KEEP + i],
        )  # fmt: skip
        w[SUM + i] += eta
        w[ROW[18] + i], w[ROW[19] + i], w[ROW[20] + i] = gux, guy, guz
        w[ROW[21] + i], w[ROW[22] + i], w[ROW[23] + i] = gvx, gvy, gvz
        w[ROW[24] + i], w[ROW[25] + i], w[ROW[26] + i] = gwx, gwy, gwz


@serial
def _products(w, delta):
    """The same, and along the directions in A: the slopes, added to SLOPE, and second derivatives, written to H."""
    for i in range(ALL):
        (
            eta, along,
            gux, guy, guz, gvx, gvy, gvz, gwx, gwy, gwz,
            hux, huy, huz, hvx, hvy, hvz, hwx, hwy, hwz,
        ) = tetrahedron.product(
            w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i],
            w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i],
            w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i],
            w[ROW[9] + i], w[ROW[10] + i], w[ROW[11] + i],
            w[ROW[12] + i], w[ROW[13] + i], w[ROW[14] + i],
            w[ROW[15] + i], w[ROW[16] + i], w[ROW[17] + i], delta, w[KEEP + i],
        )  # fmt: skip
        w[SUM + i] += eta
        w[SLOPE + i] += along
        w[ROW[18] + i], w[ROW[19] + i], w[ROW[20] + i] = gux, guy, guz
        w[ROW[21] + i], w[ROW[22] + i], w[ROW[23] + i] = gvx, gvy, gvz
        w[ROW[24] + i], w[ROW[25] + i], w[ROW[26] + i] = gwx, gwy, gwz
        w[ROW[27] + i], w[ROW[28] + i], w[ROW[29] + i] = hux, huy, huz
        w[ROW[30] + i], w[ROW[31] + i], w[ROW[32] + i] = hvx, hvy, hvz
        w[ROW[33] + i], w[ROW[34] + i], w[ROW[35] + i] = hwx, hwy, hwz


@parallel
def energies(points, hexes, delta, left_out, eta):
    """eta(H) of every hex with the barrier of (3.2) softened by delta, in the unit of sigma; writes eta (m,)."""
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, w = np.empty(CORNERS), np.empty(WORK)
        end = min(m, (chunk + 1) * CHUNK)
        for begin in range(chunk * CHUNK, end, LANES):
            count = min(LANES, end - begin)
            load(points, hexes, begin, count, x)
            some = start_sums(left_out, begin, count, w)
            for t in range(8):
                if some:
                    select(left_out, begin, count, t, w)
                edges(x, t, w, S)
                _add_energies(w, delta)
            for i in range(count):
                eta[begin + i] = max(w[SUM + np.uint64(i)] / 8 - 1, 0.0)


@parallel
def gradient(points, hexes, delta, p, left_out, blocks):
    """Gradient of sum eta(H)^p by the corners of every hex; writes blocks (m, 8, 3).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta, p : float
    left_out : (m,) uint8
        Bit t set: corner tetrahedron t of the hex is left out, as if it were perfect.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, w, g = np.empty(CORNERS), np.empty(WORK), np.empty(CORNERS)
        end = min(m, (chunk + 1) * CHUNK)
        for begin in range(chunk * CHUNK, end, LANES):
            count = min(LANES, end - begin)
            load(points, hexes, begin, count, x)
            some = start_sums(left_out, begin, count, w)
            fill(g, 0, CORNERS, 0.0)
            for t in range(8):
                if some:
                    select(left_out, begin, count, t, w)
                edges(x, t, w, S)
                _gradients(w, delta)
                scatter(w, G, t, g)
            for i in range(count):
                first, _ = weights(w[SUM + np.uint64(i)] / 8 - 1, p)
                for c in range(8):
                    for k in range(3):
                        blocks[begin + i, c, k] = first * g[(3 * c + k) * STRIDE + i]


@parallel
def hessian_product(points, hexes, slots, values, delta, p, left_out, blocks):
    """Hessian of sum eta(H)^p times a displacement of the free nodes; writes blocks (m, 8, 3).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    slots : (m, 8) int32
        Number of each corner among the free nodes, -1 if it is fixed.
    values : (free nodes, 3) float64
    delta, p : float
    left_out : (m,) uint8
        Bit t set: corner tetrahedron t of the hex is left out, as if it were perfect.
    """
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, a, w = np.empty(CORNERS), np.empty(CORNERS), np.empty(WORK)
        g, hv = np.empty(CORNERS), np.empty(CORNERS)
        end = min(m, (chunk + 1) * CHUNK)
        for begin in range(chunk * CHUNK, end, LANES):
            count = min(LANES, end - begin)
            load(points, hexes, begin, count, x)
            load(values, slots, begin, count, a)
            some = start_sums(left_out, begin, count, w)
            fill(g, 0, CORNERS, 0.0)
            fill(hv, 0, CORNERS, 0.0)
            for t in range(8):
                if some:
                    select(left_out, begin, count, t, w)
                edges(x, t, w, S)
                edges(a, t, w, A)
                _products(w, delta)
                scatter(w, G, t, g)
                scatter(w, H, t, hv)
            for i in range(count):
                first, second = weights(w[SUM + np.uint64(i)] / 8 - 1, p)
                along = second * w[SLOPE + np.uint64(i)]
                for c in range(8):
                    for k in range(3):
                        row = (3 * c + k) * STRIDE + i
                        blocks[begin + i, c, k] = first * hv[row] + along * g[row]


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
