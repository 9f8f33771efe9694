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

from hexmend.kernels import formula, parallel, serial
from hexmend.kernels.symmetric import extreme_eigenvalues

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


@formula
def _direction(positive, i, residual, z):
    """z = D residual in slot i; returns its product with the residual."""
    x, y, w = residual[i, 0], residual[i, 1], residual[i, 2]
    z[i, 0], z[i, 1], z[i, 2] = _times(positive, i, x, y, w)
    return np.float64(z[i, 0] * x + z[i, 1] * y + z[i, 2] * w)


@serial
def _backward(begin, end, row_start, inner_end, columns, off, inverse, z, beta, v, t):
    """The next direction, v = z + beta v, and the solution of (D + U) t = v, in a part."""
    for row in range(end - 1, begin - 1, -1):
        i = np.uint64(row)
        x, y, z_ = z[i, 0] + beta * v[i, 0], z[i, 1] + beta * v[i, 1], z[i, 2] + beta * v[i, 2]
        v[i, 0], v[i, 1], v[i, 2] = x, y, z_
        for at in range(inner_end[i] - 1, row_start[i] - 1, -1):  # the nearest, known last, comes last
            s, j = np.uint64(at), np.uint64(columns[at])
            p, q, r = t[j, 0], t[j, 1], t[j, 2]
            x -= off[s, 0] * p + off[s, 1] * q + off[s, 2] * r
            y -= off[s, 3] * p + off[s, 4] * q + off[s, 5] * r
            z_ -= off[s, 6] * p + off[s, 7] * q + off[s, 8] * r
        t[i, 0], t[i, 1], t[i, 2] = _times(inverse, i, x, y, z_)


@serial
def _forward(begin, end, row_start, inner_end, columns, off, inverse, w, y):
    """Solve (D + L) y = w in a part; w is used up."""
    for row in range(begin, end):
        i = np.uint64(row)
        p, q, r = _times(inverse, i, w[i, 0], w[i, 1], w[i, 2])
        y[i, 0], y[i, 1], y[i, 2] = p, q, r
        for at in range(row_start[i], inner_end[i]):
            s, j = np.uint64(at), np.uint64(columns[at])
            w[j, 0] -= off[s, 0] * p + off[s, 3] * q + off[s, 6] * r
            w[j, 1] -= off[s, 1] * p + off[s, 4] * q + off[s, 7] * r
            w[j, 2] -= off[s, 2] * p + off[s, 5] * q + off[s, 8] * r


@formula
def _across(i, across_start, across_block, across_slot, off, t):
    """Row i of E t."""
    x, y, z = t[i, 0] * 0, t[i, 0] * 0, t[i, 0] * 0
    for at in range(across_start[i], across_start[i + 1]):
        s, j = across_block[at], across_slot[at]
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
def _add_and_multiply(begin, end, t, product, v):
    """Add t to the product, whose product with v is returned."""
    total = 0.0
    for row in range(begin, end):
        i = np.uint64(row)
        x, y, z = product[i, 0] + t[i, 0], product[i, 1] + t[i, 1], product[i, 2] + t[i, 2]
        product[i, 0], product[i, 1], product[i, 2] = x, y, z
        total += np.float64(v[i, 0] * x + v[i, 1] * y + v[i, 2] * z)
    return total


@serial
def _advance(begin, end, alpha, t, product, positive, x, residual, z):
    """One step on; z = D residual, whose product with the residual is returned."""
    total = 0.0
    for row in range(begin, end):
        i = np.uint64(row)
        for j in range(3):
            x[i, np.uint64(j)] += alpha * t[i, np.uint64(j)]
            residual[i, np.uint64(j)] -= alpha * product[i, np.uint64(j)]
        total += _direction(positive, i, residual, z)
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
    off : (blocks, 9) float
    diagonal : (k, 6) float
    damping : float
        This multiple of D is added to the diagonal.
    right : (k, 3) float
    tolerance : float
        Of the residual, relative to the right-hand side, both in the norm of M^-1.
    most : int
        Limit of iterations.
    x : (k, 3) float, written

    Returns
    -------
    iterations, end : int
        `end` is DONE, NEGATIVE_CURVATURE or TOO_MANY.
    """
    k = right.shape[0]
    parts = (k + part - 1) // part
    positive, inverse, rest = np.empty_like(diagonal), np.empty_like(diagonal), np.empty_like(diagonal)
    residual, v, t = np.empty_like(right), np.empty_like(right), np.empty_like(right)
    z, product, w = np.empty_like(right), np.empty_like(right), np.empty_like(right)
    sums = np.empty(parts)
    for c in numba.prange(parts):
        begin, end = c * part, min(k, (c + 1) * part)
        for i in range(begin, end):
            _positive(diagonal, i, damping, positive, inverse, rest)
            for j in range(3):
                x[i, j], v[i, j], w[i, j] = 0, 0, right[i, j]
        _forward(begin, end, row_start, inner_end, columns, off, inverse, w, residual)
        total = 0.0
        for i in range(begin, end):
            total += _direction(positive, i, residual, z)
        sums[c] = total
    square = sums.sum()
    goal, beta = tolerance * tolerance * square, right.dtype.type(0)
    for count in range(1, most + 1):
        for c in numba.prange(parts):
            _backward(c * part, min(k, (c + 1) * part), row_start, inner_end, columns, off, inverse, z, beta, v, t)
        for c in numba.prange(parts):
            begin, end = c * part, min(k, (c + 1) * part)
            for i in range(begin, end):
                rx, ry, rz = _times(rest, i, t[i, 0], t[i, 1], t[i, 2])
                ex, ey, ez = _across(i, across_start, across_block, across_slot, off, t)
                w[i, 0], w[i, 1], w[i, 2] = v[i, 0] + rx + ex, v[i, 1] + ry + ey, v[i, 2] + rz + ez
            _forward(begin, end, row_start, inner_end, columns, off, inverse, w, product)
            sums[c] = _add_and_multiply(begin, end, t, product, v)
        curvature = sums.sum()
        if not curvature > 0:
            if count == 1:
                for i in range(k):
                    if np.isfinite(curvature):
                        x[i, 0], x[i, 1], x[i, 2] = t[i, 0], t[i, 1], t[i, 2]
                    else:  # M has left the range of numbers: block Jacobi's direction
                        x[i, 0], x[i, 1], x[i, 2] = _times(inverse, i, right[i, 0], right[i, 1], right[i, 2])
            return count, NEGATIVE_CURVATURE
        alpha = right.dtype.type(square / curvature)
        for c in numba.prange(parts):
            sums[c] = _advance(c * part, min(k, (c + 1) * part), alpha, t, product, positive, x, residual, z)
        before, square = square, sums.sum()
        if square <= goal:
            return count, DONE
        beta = right.dtype.type(square / before)
    return most, TOO_MANY


@parallel
def product(part, row_start, columns, inner_end, across_start, across_block, across_slot, off, diagonal, x, y):
    """A times x (k, 3); writes y (k, 3)."""
    k = x.shape[0]
    for c in numba.prange((k + part - 1) // part):
        begin, end = c * part, min(k, (c + 1) * part)
        for i in range(begin, end):
            ax, ay, az = _times(diagonal, i, x[i, 0], x[i, 1], x[i, 2])
            ex, ey, ez = _across(i, across_start, across_block, across_slot, off, x)
            y[i, 0], y[i, 1], y[i, 2] = ax + ex, ay + ey, az + ez
        for row in range(begin, end):
            i = np.uint64(row)
            a, b, c_ = x[i, 0], x[i, 1], x[i, 2]
            sx, sy, sz = y[i, 0], y[i, 1], y[i, 2]
            for at in range(row_start[i], inner_end[i]):
                s, j = np.uint64(at), np.uint64(columns[at])
                p, q, r = x[j, 0], x[j, 1], x[j, 2]
                sx += off[s, 0] * p + off[s, 1] * q + off[s, 2] * r
                sy += off[s, 3] * p + off[s, 4] * q + off[s, 5] * r
                sz += off[s, 6] * p + off[s, 7] * q + off[s, 8] * r
                y[j, 0] += off[s, 0] * a + off[s, 3] * b + off[s, 6] * c_
                y[j, 1] += off[s, 1] * a + off[s, 4] * b + off[s, 7] * c_
                y[j, 2] += off[s, 2] * a + off[s, 5] * b + off[s, 8] * c_
            y[i, 0], y[i, 1], y[i, 2] = sx, sy, sz
