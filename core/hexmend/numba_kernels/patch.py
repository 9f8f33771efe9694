"""The energy of a node's patch as a function of that node alone.

Each attached hex has four corner tetrahedra that hold the node: the one whose apex it is, and those of its three edge
neighbours. The other four do not change as the node moves. At the node's displacement y,

    sigma = sigma_0 + g . y          |S|^2 = s_0 + b . y + k |y|^2,   k = 3 at the apex, else 1,

because a determinant is linear in each of its columns. A patch is therefore a table of numbers a tetrahedron, made once
a visit, on which value, gradient and every trial of the line search are short loops over lanes.

Every hex is turned so that the node is its corner 0: what is to be done is then the same in all lanes. Tables come in
blocks of eight hexes, as many as meet at a regular node; in a block that is not full the last hex is repeated, and left
out of the sums.
"""

from __future__ import annotations

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from hexmend.numba_kernels import formula, serial
from hexmend.numba_kernels.hexahedron import weights
from hexmend.numba_kernels.shape import barrier, determinant, power_minus_two_thirds
from hexmend.numba_kernels.tetrahedron import own_second

#: Hexes in a block, and the tetrahedra in it that hold the node: number j of hex s is in lane 8 j + s.
HEXES, LANES = 8, 32

#: The same, for loops over lanes.
_HEXES, _LANES = np.uint64(HEXES), np.uint64(LANES)

#: Rows of one value a hex: coordinates of its corners; the sum of eta over the tetrahedra that do not hold the node,
#: eta(H), sums of derivatives. All rows lie in one array, at known distances (see `lanes`).
_X = tuple(np.uint64(HEXES * i) for i in range(24))
C0, C1, C2, C3, C4, C5, C6, C7 = _X[::3]  # numbers in the text would each be compiled for themselves
_REST, _ENERGY = np.uint64(HEXES * 24), np.uint64(HEXES * 25)
_SUM = tuple(np.uint64(HEXES * i) for i in range(26, 35))

#: Rows of one value a tetrahedron: sigma_0, g, s_0, b, k; then eta, r, and derivatives.
_SIGMA, _GX, _GY, _GZ, _SQUARE, _BX, _BY, _BZ, _K, _ETA, _R = (np.uint64(LANES * i) for i in range(9, 20))
_EACH = tuple(np.uint64(LANES * i) for i in range(20, 29))

#: Length of a block.
TABLE = 29 * LANES


def _turned(corner: int) -> list[int]:
    """The corners of a hex as the unit cube numbers them after a rotation that makes `corner` its corner 0."""
    y, z, x = UNIT_CUBE[CORNER_TETRAHEDRA[corner, 1:]] - UNIT_CUBE[corner]
    places = UNIT_CUBE[corner] + UNIT_CUBE @ np.array([x, y, z])
    return [int(np.flatnonzero((place == UNIT_CUBE).all(axis=1))[0]) for place in places]


#: Of each corner: where the corners of the turned hex are in the hex, (8, 8).
TURNED = np.array([_turned(c) for c in range(8)], dtype=np.int64)


@serial
def blocks_of(size):
    """How many blocks a patch of so many hexes takes."""
    return (size + HEXES - 1) // HEXES


@serial
def _block(size, block):
    """Where a block's table begins, and how many hexes it has."""
    return np.uint64(TABLE * block), min(HEXES, size - HEXES * block)


@serial
def load(points, hexes, corners, begin, size, table):
    """Write the corners of a patch's hexes, turned, relative to its node.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    corners : (8 m,) int32
        8 * hex + corner; the patch's are corners[begin:begin + size], its node being the same for all.
    table : (TABLE * blocks or more,) float64, written
        Coordinate k of corner c of hex s at 8 (3 c + k) + s of its block.
    """
    node = hexes[corners[begin] // 8, corners[begin] % 8]
    ox, oy, oz = points[node, 0], points[node, 1], points[node, 2]
    for s in range(HEXES * blocks_of(size)):
        corner = corners[begin + min(s, size - 1)]
        h, turn = corner // 8, corner % 8
        at = s // HEXES * TABLE + s % HEXES
        for c in range(8):
            i = hexes[h, TURNED[turn, c]]
            table[at + 3 * HEXES * c] = points[i, 0] - ox
            table[at + 3 * HEXES * c + HEXES] = points[i, 1] - oy
            table[at + 3 * HEXES * c + 2 * HEXES] = points[i, 2] - oz


@formula
def _edge(table, i, a, b):
    """From the corner whose rows begin at a to that whose rows begin at b."""
    return (
        table[i + b] - table[i + a],
        table[i + b + _X[1]] - table[i + a + _X[1]],
        table[i + b + _X[2]] - table[i + a + _X[2]],
    )


@formula
def _far(table, i, a, b):
    """Distance of two corners."""
    dx, dy, dz = _edge(table, i, a, b)
    return np.sqrt(dx * dx + dy * dy + dz * dz)


@serial
def rescale(table, size):
    """Multiply the corners by one over the mean edge length of the patch, each edge counted once a hex.

    Returns the factor; 0 if the patch has no extent.
    """
    total = 0.0
    for block in range(blocks_of(size)):
        at, count = _block(size, block)
        for s in range(_HEXES):
            i = at + s
            along_x = _far(table, i, C0, C1) + _far(table, i, C3, C2) + _far(table, i, C4, C5) + _far(table, i, C7, C6)
            along_y = _far(table, i, C0, C3) + _far(table, i, C1, C2) + _far(table, i, C4, C7) + _far(table, i, C5, C6)
            along_z = _far(table, i, C0, C4) + _far(table, i, C1, C5) + _far(table, i, C3, C7) + _far(table, i, C2, C6)
            table[i + _ENERGY] = along_x + along_y + along_z
        for s in range(count):
            total += table[at + _ENERGY + np.uint64(s)]
    scale = 12 * size / total if total > 0 else 0.0
    for block in range(blocks_of(size)):
        at, _ = _block(size, block)
        for i in range(_REST):
            table[at + i] *= scale
    return scale


@formula
def _square(ux, uy, uz, vx, vy, vz, wx, wy, wz):
    return ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz


@formula
def _tabulate_own(table, i, t):
    """The node's own tetrahedron: S = [u - y, v - y, w - y]."""
    ux, uy, uz = table[i + _X[9]], table[i + _X[10]], table[i + _X[11]]
    vx, vy, vz = table[i + _X[12]], table[i + _X[13]], table[i + _X[14]]
    wx, wy, wz = table[i + _X[3]], table[i + _X[4]], table[i + _X[5]]
    table[t + _SIGMA] = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    table[t + _GX] = -((vy * wz - vz * wy) + (wy * uz - wz * uy) + (uy * vz - uz * vy))
    table[t + _GY] = -((vz * wx - vx * wz) + (wz * ux - wx * uz) + (uz * vx - ux * vz))
    table[t + _GZ] = -((vx * wy - vy * wx) + (wx * uy - wy * ux) + (ux * vy - uy * vx))
    table[t + _SQUARE] = _square(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    table[t + _BX], table[t + _BY], table[t + _BZ] = -2 * (ux + vx + wx), -2 * (uy + vy + wy), -2 * (uz + vz + wz)
    table[t + _K] = 3.0


@formula
def _tabulate_neighbour(table, i, a, b, c, t):
    """A neighbour's tetrahedron: S = [y - a, u, v], u and v being its edges to b and c."""
    ax, ay, az = table[i + a], table[i + a + _X[1]], table[i + a + _X[2]]
    ux, uy, uz = _edge(table, i, a, b)
    vx, vy, vz = _edge(table, i, a, c)
    gx, gy, gz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    table[t + _SIGMA] = -(ax * gx + ay * gy + az * gz)
    table[t + _GX], table[t + _GY], table[t + _GZ] = gx, gy, gz
    table[t + _SQUARE] = _square(ax, ay, az, ux, uy, uz, vx, vy, vz)
    table[t + _BX], table[t + _BY], table[t + _BZ] = -2 * ax, -2 * ay, -2 * az
    table[t + _K] = 1.0


@formula
def _tabulate_apart(table, i, a, b, c, d, t):
    """Determinant and square of a tetrahedron that does not hold the node."""
    ux, uy, uz = _edge(table, i, a, b)
    vx, vy, vz = _edge(table, i, a, c)
    wx, wy, wz = _edge(table, i, a, d)
    table[t + _R] = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    table[t + _ETA] = _square(ux, uy, uz, vx, vy, vz, wx, wy, wz)


@formula
def _energy(sigma, square, delta):
    """eta(T), (3.1), and r."""
    h, r = barrier(sigma, delta)
    return square * (1.0 / 3.0) * power_minus_two_thirds(h), r


@serial
def tabulate(table, size, delta):
    """Write a patch's table from its scaled corners.

    Parameters
    ----------
    table : (TABLE * blocks or more,) float64, changed
    delta : float
        Meant for edges of mean length 1.
    """
    for block in range(blocks_of(size)):
        to, _ = _block(size, block)
        for s in range(_HEXES):  # corner tetrahedra as in CORNER_TETRAHEDRA, neighbours' beginning with the node
            i = t = to + s
            _tabulate_own(table, i, t)
            _tabulate_neighbour(table, i, C1, C5, C2, t + _X[1])
            _tabulate_neighbour(table, i, C3, C2, C7, t + _X[2])
            _tabulate_neighbour(table, i, C4, C7, C5, t + _X[3])
            _tabulate_apart(table, i, C2, C1, C6, C3, t)
            _tabulate_apart(table, i, C5, C4, C6, C1, t + _X[1])
            _tabulate_apart(table, i, C6, C5, C7, C2, t + _X[2])
            _tabulate_apart(table, i, C7, C6, C4, C3, t + _X[3])
        for lane in range(_LANES):
            t = to + lane
            table[t + _ETA], _ = _energy(table[t + _R], table[t + _ETA], delta)
        for s in range(_HEXES):
            table[to + _REST + s] = _sum_of_four(table, to + _ETA + s)


@formula
def _sum_of_four(table, i):
    """Sum over the tetrahedra of a hex."""
    return (table[i] + table[i + _X[1]]) + (table[i + _X[2]] + table[i + _X[3]])


@formula
def _moved(table, t, y0, y1, y2, far):
    """sigma and |S|^2 with the node displaced by y."""
    sigma = table[t + _SIGMA] + table[t + _GX] * y0 + table[t + _GY] * y1 + table[t + _GZ] * y2
    square = table[t + _SQUARE] + table[t + _BX] * y0 + table[t + _BY] * y1 + table[t + _BZ] * y2
    return sigma, square + table[t + _K] * far


@serial
def _energies(table, to, y0, y1, y2, delta):
    """eta(T) and eta(H) of a block with the node displaced by y, and r."""
    far = y0 * y0 + y1 * y1 + y2 * y2
    if delta == 0:  # a loop of its own: without root and quotient
        for lane in range(_LANES):
            t = to + lane
            sigma, square = _moved(table, t, y0, y1, y2, far)
            table[t + _ETA], table[t + _R] = _energy(sigma, square, 0.0)
    else:
        for lane in range(_LANES):
            t = to + lane
            sigma, square = _moved(table, t, y0, y1, y2, far)
            table[t + _ETA], table[t + _R] = _energy(sigma, square, delta)
    for s in range(_HEXES):
        table[to + _ENERGY + s] = (_sum_of_four(table, to + _ETA + s) + table[to + _REST + s]) / 8 - 1


@serial
def value(table, size, y0, y1, y2, delta, p):
    """Sum over the patch's hexes of eta(H)^p with the node displaced by y: (3.3) without its root, (B.20)."""
    total = 0.0
    for block in range(blocks_of(size)):
        to, count = _block(size, block)
        _energies(table, to, y0, y1, y2, delta)
        for s in range(count):
            # Softened by delta, a hex better than perfect counts as perfect.
            energy = max(table[to + _ENERGY + np.uint64(s)], 0.0)
            total += energy * energy if p == 2 else energy**p
    return total


@serial
def value_and_gradient(table, size, delta, p):
    """Value where the node is, and its gradient: (B.3), (B.21), (C.1).

    Leaves in the table what `hessian` begins with.
    """
    total, gx, gy, gz = 0.0, 0.0, 0.0, 0.0
    for block in range(blocks_of(size)):
        to, count = _block(size, block)
        _energies(table, to, 0.0, 0.0, 0.0, delta)
        for lane in range(_LANES):
            t = to + lane
            # d eta = 2 eta [ (dS, S)/|S|^2 - d sigma/(3 r) ]
            stretch, squeeze = table[t + _ETA] / table[t + _SQUARE], 2 * table[t + _ETA] / (3 * table[t + _R])
            table[t + _EACH[0]] = stretch * table[t + _BX] - squeeze * table[t + _GX]
            table[t + _EACH[1]] = stretch * table[t + _BY] - squeeze * table[t + _GY]
            table[t + _EACH[2]] = stretch * table[t + _BZ] - squeeze * table[t + _GZ]
        for s in range(_HEXES):
            table[to + _SUM[0] + s] = _sum_of_four(table, to + _EACH[0] + s) / 8
            table[to + _SUM[1] + s] = _sum_of_four(table, to + _EACH[1] + s) / 8
            table[to + _SUM[2] + s] = _sum_of_four(table, to + _EACH[2] + s) / 8
        for k in range(count):
            s = to + np.uint64(k)
            energy = table[s + _ENERGY]
            first, _ = weights(energy, p)
            energy = max(energy, 0.0)
            total += energy * energy if p == 2 else energy**p
            gx += first * table[s + _SUM[0]]
            gy += first * table[s + _SUM[1]]
            gz += first * table[s + _SUM[2]]
    return total, gx, gy, gz


@serial
def hessian(table, size, p):
    """Second derivatives of the value where the node is, (xx xy xz yy yz zz): (B.19) mended, (B.22).

    The table is as `value_and_gradient` has left it.
    """
    xx, xy, xz, yy, yz, zz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for block in range(blocks_of(size)):
        to, count = _block(size, block)
        for lane in range(_LANES):
            t = to + lane
            square = table[t + _SQUARE]
            (
                table[t + _EACH[3]], table[t + _EACH[4]], table[t + _EACH[5]],
                table[t + _EACH[6]], table[t + _EACH[7]], table[t + _EACH[8]],
            ) = own_second(
                table[t + _ETA] / square, square, table[t + _SIGMA], table[t + _R], table[t + _K],
                table[t + _BX] / 2, table[t + _BY] / 2, table[t + _BZ] / 2,
                table[t + _GX], table[t + _GY], table[t + _GZ],
            )  # fmt: skip
        for s in range(_HEXES):
            table[to + _SUM[3] + s] = _sum_of_four(table, to + _EACH[3] + s) / 8
            table[to + _SUM[4] + s] = _sum_of_four(table, to + _EACH[4] + s) / 8
            table[to + _SUM[5] + s] = _sum_of_four(table, to + _EACH[5] + s) / 8
            table[to + _SUM[6] + s] = _sum_of_four(table, to + _EACH[6] + s) / 8
            table[to + _SUM[7] + s] = _sum_of_four(table, to + _EACH[7] + s) / 8
            table[to + _SUM[8] + s] = _sum_of_four(table, to + _EACH[8] + s) / 8
        for k in range(count):
            s = to + np.uint64(k)
            first, second = weights(table[s + _ENERGY], p)
            ex, ey, ez = table[s + _SUM[0]], table[s + _SUM[1]], table[s + _SUM[2]]
            xx += first * table[s + _SUM[3]] + second * ex * ex
            xy += first * table[s + _SUM[4]] + second * ex * ey
            xz += first * table[s + _SUM[5]] + second * ex * ez
            yy += first * table[s + _SUM[6]] + second * ey * ey
            yz += first * table[s + _SUM[7]] + second * ey * ez
            zz += first * table[s + _SUM[8]] + second * ez * ez
    return xx, xy, xz, yy, yz, zz
