"""Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.

The preconditioner is M = (D + L) D^-1 (D + U), D being the diagonal blocks made positive definite, L and U = L' the
blocks below and above it that lie inside a part of the slots. Eisenstat's way (1981) costs two triangular solves an
iteration, and no product: for t = (D + U)^-1 v and A = L + A_D + U + E,

    (D + L)^-1 A t = t + (D + L)^-1 (v - (2 D - A_D) t + E t).

The parts are solved side by side; E holds the blocks across. Where a part is one slot, M is block Jacobi.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import formula, parallel, serial
from hexmend.numba_kernels.block_rows import subtract_transposed, times
from hexmend.numba_kernels.symmetric import extreme_eigenvalues

#: What the count of iterations comes with: how it ended.
DONE, NEGATIVE_CURVATURE, TOO_MANY = 0, 1, 2


@serial
def _positive(blocks, i, damping, positive, inverse, rest):
    """D, D^-1 and the rest, block i - 2 D; D is block i with its least eigenvalue raised as in Algorithm A.4."""
    xx, xy, xz = np.float64(blocks[i, 0]), np.float64(blocks[i, 1]), np.float64(blocks[i, 2])
    yy, yz, zz = np.float64(blocks[i, 3]), np.float64(blocks[i, 4]), np.float64(blocks[i, 5])
    least, greatest = extreme_eigenvalues(xx, xy, xz, yy, yz, zz)
    size = max(abs(least), abs(greatest))
    if size == 0:
        size = 1.0
    shift = max(0.001 * size - least, 0.0)
    if least < 0:  # so small a D beside the blocks off the diagonal would make the triangular solves grow without bound
        shift = 0.5 * size - least
    xx, yy, zz = xx + shift, yy + shift, zz + shift
    cxx, cxy, cxz = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    det = xx * cxx + xy * cxy + xz * cxz
    if not det > 0:  # all but of rank 1 or 2: its scale alone
        xx, xy, xz, yy, yz, zz = size, 0.0, 0.0, size, 0.0, size
        cxx, cxy, cxz, det = size * size, 0.0, 0.0, size**3
    positive[i, 0], positive[i, 1], positive[i, 2] = xx, xy, xz
    positive[i, 3], positive[i, 4], positive[i, 5] = yy, yz, zz
    inverse[i, 0], inverse[i, 1], inverse[i, 2] = cxx / det, cxy / det, cxz / det
    inverse[i, 3], inverse[i, 4] = (xx * zz - xz * xz) / det, (xy * xz - xx * yz) / det
    inverse[i, 5] = (xx * yy - xy * xy) / det
    for j in range(6):
        rest[i, j] = blocks[i, j] - (2 + damping) * positive[i, j]
        positive[i, j] *= 1 + damping
        inverse[i, j] /= 1 + damping


@formula
def _times(blocks, i, x, y, z):
    """Symmetric block i times (x, y, z)."""
    xx, xy, xz, yy, yz, zz = blocks[i, 0], blocks[i, 1], blocks[i, 2], blocks[i, 3], blocks[i, 4], blocks[i, 5]
    return xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z


@serial
def _backward(begin, end, row_start, inner_end, columns, off, inverse, positive, residual, beta, v, t):
    """The next direction, v = D residual + beta v, and the solution of (D + U) t = v, in a part."""
    for row in range(end - 1, begin - 1, -1):
        i = np.uint64(row)
        zx, zy, zz = _times(positive, i, residual[i, 0], residual[i, 1], residual[i, 2])
        x, y, z = zx + beta * v[i, 0], zy + beta * v[i, 1], zz + beta * v[i, 2]
        v[i, 0], v[i, 1], v[i, 2] = x, y, z
        # The nearest, known last, comes last.
        sx, sy, sz = times(off, columns, t, row_start[i], inner_end[i])
        t[i, 0], t[i, 1], t[i, 2] = _times(inverse, i, x - sx, y - sy, z - sz)


@serial
def _forward(begin, end, row_start, inner_end, columns, across, off, inverse, rest, v, t, w, product):
    """product = t + (D + L)^-1 (v + rest t + E t) in a part, and its product with v; w is scratch, 0 before and after.

    What the rows above have subtracted from a row is in w.
    """
    total = 0.0
    for row in range(begin, end):
        i = np.uint64(row)
        tx, ty, tz = t[i, 0], t[i, 1], t[i, 2]
        vx, vy, vz = v[i, 0], v[i, 1], v[i, 2]
        rx, ry, rz = _times(rest, i, tx, ty, tz)
        ex, ey, ez = _across(i, across, off, t)
        x, y, z = w[i, 0] + vx + rx + ex, w[i, 1] + vy + ry + ey, w[i, 2] + vz + rz + ez
        w[i, 0], w[i, 1], w[i, 2] = 0, 0, 0
        p, q, r = _times(inverse, i, x, y, z)
        subtract_transposed(off, columns, w, row_start[i], inner_end[i], p, q, r)
        p, q, r = p + tx, q + ty, r + tz
        product[i, 0], product[i, 1], product[i, 2] = p, q, r
        total += np.float64(vx * p + vy * q + vz * r)
    return total


@formula
def _across(i, across, off, t):
    """Row i of E t."""
    start, block, slot = across
    x, y, z = t[i, 0] * 0, t[i, 0] * 0, t[i, 0] * 0
    for at in range(start[i], start[i + 1]):
        s, j = block[at], slot[at]
        p, q, r = t[j, 0], t[j, 1], t[j, 2]
        if j > i:
            x += off[s, 0] * p + off[s, 1] * q + off[s, 2] * r
            y += off[s, 3] * p + off[s, 4] * q + off[s, 5] * r
            z += off[s, 6] * p + off[s, 7] * q + off[s, 8] * r
        else:
            x += off[s, 0] * p + off[s, 3] * q + off[s, 6] * r
            y += off[s, 1] * p + off[s, 4] * q + off[s, 7] * r
            z += off[s, 2] * p + off[s, 5] * q + off[s, 8] * r
    return x, y, z


@serial
def _start(begin, end, row_start, inner_end, columns, off, diagonal, damping, right, positive, inverse, rest, w, start):
    """Diagonal blocks of a part, and its first residual, (D + L)^-1 right, in `start`; returns its square."""
    total = 0.0
    for row in range(begin, end):
        i = np.uint64(row)
        _positive(diagonal, i, damping, positive, inverse, rest)
        x, y, z = _times(inverse, i, w[i, 0] + right[i, 0], w[i, 1] + right[i, 1], w[i, 2] + right[i, 2])
        w[i, 0], w[i, 1], w[i, 2] = 0, 0, 0
        subtract_transposed(off, columns, w, row_start[i], inner_end[i], x, y, z)
        start[i, 0], start[i, 1], start[i, 2] = x, y, z
        total += _square(positive, i, x, y, z)
    return total


@formula
def _square(positive, i, x, y, z):
    """(x, y, z) D (x, y, z) in slot i."""
    p, q, r = _times(positive, i, x, y, z)
    return np.float64(p * x + q * y + r * z)


@serial
def _advance(begin, end, alpha, t, product, positive, x, residual):
    """One step on; returns the square of the residual."""
    total = 0.0
    for row in range(begin, end):
        i = np.uint64(row)
        x[i, 0], x[i, 1], x[i, 2] = x[i, 0] + alpha * t[i, 0], x[i, 1] + alpha * t[i, 1], x[i, 2] + alpha * t[i, 2]
        rx, ry, rz = residual[i, 0], residual[i, 1], residual[i, 2]
        rx, ry, rz = rx - alpha * product[i, 0], ry - alpha * product[i, 1], rz - alpha * product[i, 2]
        residual[i, 0], residual[i, 1], residual[i, 2] = rx, ry, rz
        total += _square(positive, i, rx, ry, rz)
    return total


@parallel
def solve(
    part,
    row_start,
    columns,
    inner_end,
    across_start,
    across_block,
    across_slot,
    off,
    diagonal,
    damping,
    right,
    tolerance,
    most,
    x,
):
    """Solve A x = right, stopping at a direction of negative curvature (Steihaug 1983).

    What has been reached before such a direction is the solution, or, if it is the first, that direction. Vectors are
    in the precision of the matrix, sums over them in double precision.

    Parameters
    ----------
    part, row_start, columns, inner_end, across_start, across_block, across_slot
        Pattern, as `couplings` makes it.
    off : (blocks + 1, 9) float
        The last is no block (see `block_rows`).
    diagonal : (k, 6) float
    damping : float
        This multiple of D is added to the diagonal.
    right : (k, 4) float
        The fourth of each is 0, as in all vectors here.
    tolerance : float
        Of the residual, relative to the right-hand side, both in the norm of M^-1.
    most : int
        Limit of iterations.
    x : (k, 4) float, written

    Returns
    -------
    iterations, end : int
        `end` is DONE, NEGATIVE_CURVATURE or TOO_MANY.
    """
    k = right.shape[0]
    parts = (k + part - 1) // part
    across = across_start, across_block, across_slot
    positive, inverse, rest = np.empty_like(diagonal), np.empty_like(diagonal), np.empty_like(diagonal)
    residual, v, t = np.zeros_like(right), np.zeros_like(right), np.zeros_like(right)
    product, w = np.zeros_like(right), np.zeros_like(right)
    x[:] = 0
    sums = np.empty(parts)
    for c in numba.prange(parts):
        begin, end = c * part, min(k, (c + 1) * part)
        sums[c] = _start(
            begin, end, row_start, inner_end, columns, off,
            diagonal, damping, right, positive, inverse, rest, w, residual,
        )  # fmt: skip
    square = sums.sum()
    goal, beta = tolerance * tolerance * square, right.dtype.type(0)
    for count in range(1, most + 1):
        for c in numba.prange(parts):
            begin, end = c * part, min(k, (c + 1) * part)
            _backward(begin, end, row_start, inner_end, columns, off, inverse, positive, residual, beta, v, t)
        for c in numba.prange(parts):
            begin, end = c * part, min(k, (c + 1) * part)
            sums[c] = _forward(
                begin, end, row_start, inner_end, columns, across, off, inverse, rest, v, t, w, product
            )  # fmt: skip
        curvature = sums.sum()
        if not curvature > 0:
            if count == 1:
                for row in range(k):
                    i = np.uint64(row)
                    if np.isfinite(curvature):
                        x[i, 0], x[i, 1], x[i, 2] = t[i, 0], t[i, 1], t[i, 2]
                    else:  # M has left the range of numbers: block Jacobi's direction
                        x[i, 0], x[i, 1], x[i, 2] = _times(inverse, i, right[i, 0], right[i, 1], right[i, 2])
            return count, NEGATIVE_CURVATURE
        alpha = right.dtype.type(square / curvature)
        for c in numba.prange(parts):
            sums[c] = _advance(c * part, min(k, (c + 1) * part), alpha, t, product, positive, x, residual)
        before, square = square, sums.sum()
        if square <= goal:
            return count, DONE
        beta = right.dtype.type(square / before)
    return most, TOO_MANY


@parallel
def product(part, row_start, columns, inner_end, across_start, across_block, across_slot, off, diagonal, x, y):
    """A times x (k, 4); writes y (k, 4)."""
    k = x.shape[0]
    across = across_start, across_block, across_slot
    y[:] = 0
    for c in numba.prange((k + part - 1) // part):
        for row in range(c * part, min(k, (c + 1) * part)):
            i = np.uint64(row)
            p, q, r = x[i, 0], x[i, 1], x[i, 2]
            ax, ay, az = _times(diagonal, i, p, q, r)
            ex, ey, ez = _across(i, across, off, x)
            sx, sy, sz = times(off, columns, x, row_start[i], inner_end[i])
            y[i, 0], y[i, 1], y[i, 2] = y[i, 0] + ax + ex + sx, y[i, 1] + ay + ey + sy, y[i, 2] + az + ez + sz
            subtract_transposed(off, columns, y, row_start[i], inner_end[i], -p, -q, -r)
