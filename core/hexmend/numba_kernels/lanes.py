"""A block of hexes side by side: one coordinate a row, one hex a lane, so that arithmetic runs over vectors.

What makes the compiler vectorise a loop over lanes, found by trial:

- the rows that it reads and writes lie in one array, at distances that are known: nothing is left to ask about overlap;
- indices are unsigned: Numba asks of a signed one whether it counts from the end;
- no branch, no call that is not taken in whole (`kernels.formula`), no row number that is known only at run time. The
  edges of a tetrahedron are therefore copied to fixed rows first, and its shares added to their rows afterwards.
"""

from __future__ import annotations

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.numba_kernels import formula, serial
from hexmend.numba_kernels.hexahedron import kept, left_out_count

#: Hexes in a block: a whole number of lines of the processor's nearest cache, but not a power of two, so that one
#: lane's values in all rows do not compete for the same few sets of it.
LANES = 72

#: Hexes that one thread takes at a time.
CHUNK = 4 * LANES

#: From the beginning of a row to that of the next.
STRIDE = LANES

#: For loops over lanes, and over the three rows of a vector: these lie one behind the other, and short loops, which
#: the compiler unrolls, would take it longer.
ALL, VECTOR = np.uint64(LANES), np.uint64(3 * STRIDE)

#: Rows of an array of work, by where they begin: nine of S, nine of a direction of it, nine of a derivative, nine of
#: another, two of sums, one that says which tetrahedra count.
ROW = tuple(np.uint64(k * STRIDE) for k in range(39))
S, A, G, H = ROW[0], ROW[9], ROW[18], ROW[27]
SUM, SLOPE, KEEP = ROW[36], ROW[37], ROW[38]

#: Length of an array of work, and of one that holds a vector at eight corners.
WORK, CORNERS = 39 * STRIDE, 24 * STRIDE


@formula
def vector(k):
    """Where the three rows of vector k begin."""
    return VECTOR * np.uint64(k)


@serial
def load(values, rows, first, count, x):
    """Write vectors at the corners of `count` hexes from `first` on into x (CORNERS,); further lanes repeat the last.

    Parameters
    ----------
    values : (n, 3) float64
    rows : (m, 8) int32
        Row of each corner; below 0 for one where the vector is zero.
    """
    for lane in range(LANES):
        h = first + min(lane, count - 1)
        for c in range(8):
            i = rows[h, c]
            for k in range(3):
                x[(3 * c + k) * STRIDE + lane] = values[i, k] if i >= 0 else 0.0


@serial
def start_sums(left_out, first, count, w):
    """Set the sums of a block: tetrahedra that are left out count as perfect. Returns whether there are any.

    Parameters
    ----------
    left_out : (m,) uint8
        Bit t set: tetrahedron t of the hex is left out.
    """
    some = False
    for lane in range(ALL):
        w[SUM + lane] = 0.0
        w[SLOPE + lane] = 0.0
        w[KEEP + lane] = 1.0
    for lane in range(count):
        bits = left_out[first + lane]
        if bits:
            some = True
            w[SUM + np.uint64(lane)] = left_out_count(bits)
    return some


@serial
def select(left_out, first, count, t, w):
    """Set the row that says of which hexes tetrahedron t counts."""
    for lane in range(count):
        w[KEEP + np.uint64(lane)] = kept(left_out[first + lane], t)


@serial
def fill(w, begin, end, value):
    """Set w from `begin` to `end`; a slice would be compiled anew, and slowly, in each kernel."""
    for i in range(begin, end):
        w[i] = value


@serial
def copy(x, begin, w, to):
    """Copy the vector of x that begins at `begin` to the one of w that begins at `to`."""
    for i in range(VECTOR):
        w[to + i] = x[begin + i]


@serial
def edges(x, t, w, to):
    """Differences along the edges of corner tetrahedron t, u, v and w, into nine rows of w from `to` on."""
    apex = vector(CORNER_TETRAHEDRA[t, 0])
    for j in range(3):
        tip, row = vector(CORNER_TETRAHEDRA[t, j + 1]), to + vector(j)
        for i in range(VECTOR):
            w[row + i] = x[tip + i] - x[apex + i]


@serial
def scatter(w, begin, t, to):
    """Add a derivative by u, v and w, nine rows of w from `begin` on, to the nodes' rows of `to` (CORNERS,)."""
    for j in range(3):
        row, tip = begin + vector(j), vector(CORNER_TETRAHEDRA[t, j + 1])
        for i in range(VECTOR):
            to[tip + i] += w[row + i]
    apex, v, z = vector(CORNER_TETRAHEDRA[t, 0]), begin + vector(1), begin + vector(2)
    for i in range(VECTOR):
        to[apex + i] -= w[begin + i] + w[v + i] + w[z + i]
