"""The Hessian of a mesh's energy, assembled: 3 x 3 blocks of the free nodes, those above the diagonal and those on it.

A product with it takes a fraction of the time of the formulas, and a preconditioner can look into it.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.numba_kernels import formula, parallel, serial, tetrahedron
from hexmend.numba_kernels.couplings import PAIRS
from hexmend.numba_kernels.hexahedron import weights
from hexmend.numba_kernels.lanes import (
    ALL,
    CORNERS,
    KEEP,
    LANES,
    ROW,
    STRIDE,
    SUM,
    WORK,
    G,
    S,
    edges,
    fill,
    load,
    scatter,
    select,
    start_sums,
)

#: Rows of the 3 x 3 blocks of a tetrahedron behind those of `lanes`: own blocks of its four nodes, then the six pairs.
_T = tuple(np.uint64(WORK + k * STRIDE) for k in range(78))
_ROWS = WORK + 78 * STRIDE

#: Pairs of a tetrahedron's nodes, as they stand in _T.
_PAIRS = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])

#: Number of the pair of two corners of a hex, the lower one first.
_PAIR_OF = np.array([[sum(7 - i for i in range(a)) + b - a - 1 for b in range(8)] for a in range(8)])

#: Values of a hex: its 28 pairs, then its 8 corners.
_OWN = 9 * PAIRS
_VALUES = _OWN + 6 * 8


def _value_of(t: int) -> list[int]:
    nodes = CORNER_TETRAHEDRA[t]
    rows = [_OWN + 6 * a + j for a in nodes for j in range(6)]
    for a, b in nodes[_PAIRS]:
        block = 9 * _PAIR_OF[min(a, b), max(a, b)] + np.arange(9).reshape(3, 3)
        rows += (block if a < b else block.T).ravel().tolist()
    return rows


#: The value of a hex that each row of _T adds to, for each corner tetrahedron, (8, 78).
_VALUE_OF = np.array([_value_of(t) for t in range(8)])

#: Length of an array of work: rows of a tetrahedron, corners and gradient, weights, sums.
_LENGTH = _ROWS + 2 * CORNERS + 2 * LANES + _VALUES * STRIDE

#: What is larger is cut to it, so that single precision holds sums of it.
_CUT = 1e34


@formula
def _put_own(w, at, cx, cy, cz, px, py, pz, k):
    """c p' + p c' + k I: xx xy xz yy yz zz, into six rows of w."""
    w[at + ROW[0]], w[at + ROW[1]], w[at + ROW[2]] = 2 * cx * px + k, cx * py + px * cy, cx * pz + px * cz
    w[at + ROW[3]], w[at + ROW[4]], w[at + ROW[5]] = 2 * cy * py + k, cy * pz + py * cz, 2 * cz * pz + k


@formula
def _put_pair(w, at, cx, cy, cz, px, py, pz, dx, dy, dz, qx, qy, qz, k, x, y, z):
    """c q' + p d' + k I + [(x, y, z)] cross, by its rows, into nine rows of w."""
    w[at + ROW[0]] = cx * qx + px * dx + k
    w[at + ROW[1]] = cx * qy + px * dy - z
    w[at + ROW[2]] = cx * qz + px * dz + y
    w[at + ROW[3]] = cy * qx + py * dx + z
    w[at + ROW[4]] = cy * qy + py * dy + k
    w[at + ROW[5]] = cy * qz + py * dz - x
    w[at + ROW[6]] = cz * qx + pz * dx - y
    w[at + ROW[7]] = cz * qy + pz * dy + x
    w[at + ROW[8]] = cz * qz + pz * dz + k


@serial
def _second_derivatives(w, delta):
    """Of the tetrahedra in S: eta(T), added to SUM, an eighth of its gradient, written to G, and of its second
    derivatives by its nodes, written to the rows behind: (B.19), mended, as `tetrahedron` has it.

    With s and c what the columns of S and of C are to a node (of the apex: minus their sum), and p = mixed s + half c,
    the block of two nodes is c p' + p c' and what d2 sigma and (V, W) add.
    """
    for i in range(ALL):
        ux, uy, uz = w[ROW[0] + i], w[ROW[1] + i], w[ROW[2] + i]
        vx, vy, vz = w[ROW[3] + i], w[ROW[4] + i], w[ROW[5] + i]
        wx, wy, wz = w[ROW[6] + i], w[ROW[7] + i], w[ROW[8] + i]
        eta, k, c, mixed, half = tetrahedron.second(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, w[KEEP + i])
        cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = tetrahedron.cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
        w[SUM + i] += eta
        w[ROW[18] + i], w[ROW[19] + i], w[ROW[20] + i] = k * ux - c * cux, k * uy - c * cuy, k * uz - c * cuz
        w[ROW[21] + i], w[ROW[22] + i], w[ROW[23] + i] = k * vx - c * cvx, k * vy - c * cvy, k * vz - c * cvz
        w[ROW[24] + i], w[ROW[25] + i], w[ROW[26] + i] = k * wx - c * cwx, k * wy - c * cwy, k * wz - c * cwz
        pux, puy, puz = mixed * ux + half * cux, mixed * uy + half * cuy, mixed * uz + half * cuz
        pvx, pvy, pvz = mixed * vx + half * cvx, mixed * vy + half * cvy, mixed * vz + half * cvz
        pwx, pwy, pwz = mixed * wx + half * cwx, mixed * wy + half * cwy, mixed * wz + half * cwz
        cax, cay, caz = -(cux + cvx + cwx), -(cuy + cvy + cwy), -(cuz + cvz + cwz)
        pax, pay, paz = -(pux + pvx + pwx), -(puy + pvy + pwy), -(puz + pvz + pwz)
        _put_own(w, _T[0] + i, cax, cay, caz, pax, pay, paz, 3 * k)
        _put_own(w, _T[6] + i, cux, cuy, cuz, pux, puy, puz, k)
        _put_own(w, _T[12] + i, cvx, cvy, cvz, pvx, pvy, pvz, k)
        _put_own(w, _T[18] + i, cwx, cwy, cwz, pwx, pwy, pwz, k)
        ux, uy, uz, vx, vy, vz, wx, wy, wz = c * ux, c * uy, c * uz, c * vx, c * vy, c * vz, c * wx, c * wy, c * wz
        _put_pair(
            w, _T[24] + i, cax, cay, caz, pax, pay, paz, cux, cuy, cuz, pux, puy, puz, -k, wx - vx, wy - vy, wz - vz
        )
        _put_pair(
            w, _T[33] + i, cax, cay, caz, pax, pay, paz, cvx, cvy, cvz, pvx, pvy, pvz, -k, ux - wx, uy - wy, uz - wz
        )
        _put_pair(
            w, _T[42] + i, cax, cay, caz, pax, pay, paz, cwx, cwy, cwz, pwx, pwy, pwz, -k, vx - ux, vy - uy, vz - uz
        )
        _put_pair(w, _T[51] + i, cux, cuy, cuz, pux, puy, puz, cvx, cvy, cvz, pvx, pvy, pvz, 0.0, wx, wy, wz)
        _put_pair(w, _T[60] + i, cux, cuy, cuz, pux, puy, puz, cwx, cwy, cwz, pwx, pwy, pwz, 0.0, -vx, -vy, -vz)
        _put_pair(w, _T[69] + i, cvx, cvy, cvz, pvx, pvy, pvz, cwx, cwy, cwz, pwx, pwy, pwz, 0.0, ux, uy, uz)


@serial
def _add_rows(w, t, to):
    """Add the blocks of corner tetrahedron t, in _T, to those of the hexes; to (_VALUES * STRIDE,)."""
    for k in range(78):
        row, there = np.uint64(WORK + k * STRIDE), np.uint64(_VALUE_OF[t, k] * STRIDE)
        for lane in range(ALL):
            to[there + lane] += w[row + lane]


@serial
def _weighted(values, g, first, second, out):
    """first * values + second * g g', cut to what single precision holds; writes out (_VALUES, ...)."""
    pair = 0
    for a in range(8):
        for b in range(a + 1, 8):
            for i in range(3):
                for j in range(3):
                    row = 9 * pair + 3 * i + j
                    _weighted_row(values, row, g, 3 * a + i, 3 * b + j, first, second, out)
            pair += 1
        row = _OWN + 6 * a
        for i in range(3):
            for j in range(i, 3):
                _weighted_row(values, row, g, 3 * a + i, 3 * a + j, first, second, out)
                row += 1


@serial
def _weighted_row(values, row, g, i, j, first, second, out):
    at, gi, gj, r = np.uint64(row * STRIDE), np.uint64(i * STRIDE), np.uint64(j * STRIDE), np.uint64(row)
    for lane in range(ALL):
        value = first[lane] * values[at + lane] + second[lane] * g[gi + lane] * g[gj + lane]
        out[r, lane] = min(max(value, -_CUT), _CUT)


@serial
def _block(points, corners, delta, p, left_out, work, values):
    """Second derivatives of eta^p of up to LANES hexes, given by their corners; writes values (_VALUES, ...)."""
    count, begin = corners.shape[0], np.int64(0)
    w, work = work[:_ROWS], work[_ROWS:]
    x, work = work[:CORNERS], work[CORNERS:]
    g, work = work[:CORNERS], work[CORNERS:]
    first, second, sums = work[:LANES], work[LANES : 2 * LANES], work[2 * LANES :]
    fill(g, 0, CORNERS, 0.0)
    fill(sums, 0, _VALUES * STRIDE, 0.0)
    load(points, corners, begin, count, x)
    some = start_sums(left_out, begin, count, w)
    for t in range(8):
        if some:
            select(left_out, begin, count, t, w)
        edges(x, t, w, S)
        _second_derivatives(w, delta)
        scatter(w, G, t, g)
        _add_rows(w, t, sums)
    for i in range(LANES):
        first[i], second[i] = weights(w[SUM + np.uint64(i)] / 8 - 1, p)
    _weighted(sums, g, first, second, values)


@formula
def _add_block(values, row, lane, column, down, off, s):
    """Add the block whose values begin at `row`, the next column `column` rows on, the next row `down`, to block s."""
    s, lane = np.uint64(s), np.uint64(lane)
    for p in range(3):
        for q in range(3):
            off[s, np.uint64(3 * p + q)] += values[np.uint64(row + down * p + column * q), lane]


@formula
def _add_own(values, row, lane, diagonal, i):
    """Add the six values that begin at `row` to the own block of slot i."""
    i, lane = np.uint64(i), np.uint64(lane)
    for j in range(6):
        diagonal[i, np.uint64(j)] += values[np.uint64(row + j), lane]


@serial
def _add_both_ways(values, row, lane, own):
    """Add a block and its transpose to a symmetric one, (6,)."""
    j = 0
    for p in range(3):
        for q in range(p, 3):
            own[j] += values[row + 3 * p + q, lane] + values[row + 3 * q + p, lane]
            j += 1


@serial
def _add(values, chosen, slots, target, low, high, off, diagonal):
    """Add the values of the chosen hexes to the blocks of slots from `low` to `high`."""
    for lane in range(chosen.size):
        h = chosen[lane]
        pair = 0
        for a in range(8):
            i = slots[h, a]
            for b in range(a + 1, 8):
                s, j = target[h, pair], slots[h, b]
                if s >= 0 and low <= min(i, j) < high:
                    over = np.uint64(2 * (i < j))
                    _add_block(values, np.uint64(9 * pair), lane, np.uint64(3) - over, np.uint64(1) + over, off, s)
                elif s < -1 and low <= i < high:  # a hex that uses a node twice
                    _add_both_ways(values, 9 * pair, lane, diagonal[i])
                pair += 1
            if low <= i < high:
                _add_own(values, _OWN + 6 * a, lane, diagonal, i)


@parallel
def assemble(points, hexes, delta, p, left_out, slots, target, bounds, start, chosen, off, diagonal):
    """Assemble the Hessian of sum eta(H)^p: add it to off and diagonal, in their precision.

    Slots are shared out, and each share takes all hexes at its slots: some hexes are computed twice, and every block is
    the sum over its hexes in one order, however many shares there are.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta, p : float
    left_out : (m,) uint8
        Bit t set: corner tetrahedron t of the hex is left out, as if it were perfect.
    slots : (m, 8) int32
        Slot of each corner, -1 if it is fixed.
    target : (m, 28) int32
        From `couplings.targets`.
    bounds : (shares + 1,) int32
        The slots of share k are those from bounds[k] to bounds[k + 1].
    start : (shares + 1,) int32
    chosen : (start[shares],) int32
        The hexes of share k are chosen[start[k]:start[k + 1]].
    off : (blocks + 1, 9) float
        Blocks above the diagonal, by rows, and one that is none.
    diagonal : (k, 6) float
        xx xy xz yy yz zz.
    """
    for share in numba.prange(bounds.size - 1):
        work, values = np.empty(_LENGTH), np.empty((_VALUES, LANES + 16), off.dtype)
        corners, bits = np.empty((LANES, 8), np.int32), np.empty(LANES, np.uint8)
        for begin in range(start[share], start[share + 1], LANES):
            some = chosen[begin : min(begin + LANES, start[share + 1])]
            for lane in range(some.size):
                bits[lane] = left_out[some[lane]]
                for c in range(8):
                    corners[lane, c] = hexes[some[lane], c]
            _block(points, corners[: some.size], delta, p, bits, work, values)
            _add(values, some, slots, target, bounds[share], bounds[share + 1], off, diagonal)
