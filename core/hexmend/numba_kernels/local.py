"""One line-searched step per free node: a sweep of local optimisation, colour by colour."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import parallel, patch, serial, symmetric

#: Nodes that one thread takes at a time.
_CHUNK = 64


#: Search directions.
STEEPEST_DESCENT, NEWTON, MODIFIED_NEWTON = range(3)


@serial
def steepest_descent(f, gx, gy, gz, p):
    """Algorithm A.2: p_k = -grad of the p-th root of f, the objective (3.3) of the patch."""
    factor = -0.5 / np.sqrt(f) if p == 2 else -(f ** (1 / p - 1)) / p  # (C.2)
    return factor * gx, factor * gy, factor * gz


@serial
def newton(hessian, gx, gy, gz, modified):
    """Algorithms A.3 and A.4: H p_k = -grad f, in A.4 after the least eigenvalue was raised."""
    xx, xy, xz, yy, yz, zz = hessian
    if modified:
        least, greatest = symmetric.extreme_eigenvalues(xx, xy, xz, yy, yz, zz)
        if least < 0.001 * greatest:
            shift = 0.001 * greatest - least
            xx, yy, zz = xx + shift, yy + shift, zz + shift
    return symmetric.solve(xx, xy, xz, yy, yz, zz, -gx, -gy, -gz)


@serial
def back_line_search(table, size, delta, p, f, slope, dx, dy, dz, first, shrink, c1, cuts):
    """Algorithm A.5 along d.

    Returns
    -------
    alpha : float
        The accepted step; 0 if none of `cuts` + 1 trials descends enough.
    """
    alpha = first
    for _ in range(cuts + 1):
        trial = patch.value(table, size, alpha * dx, alpha * dy, alpha * dz, delta, p)
        if trial < f + c1 * alpha * slope:
            return alpha
        alpha *= shrink
    return 0.0


@parallel
def sweep(points, hexes, start, corners, groups, nodes, direction, delta, p, first, shrink, c1, cuts):
    """Move every node of `nodes` once, in place: one pass of Algorithm 3.2.

    Nodes of one group share no hex, so that each sees the others where they stay and the order within a group does not
    matter: the result is that of a sequential sweep, whatever the number of threads.

    Parameters
    ----------
    points : (n, 3) float64, changed
    hexes : (m, 8) int32
    start, corners : (n + 1,) int32, (8 m,) int32
        Corners of hexes at each node.
    groups, nodes : (colours + 1,) int32, (free nodes,) int32
        Group k is nodes[groups[k]:groups[k + 1]].
    direction : int
        STEEPEST_DESCENT, NEWTON or MODIFIED_NEWTON.
    delta : float
        On the patch scaled to mean edge length 1.
    p, first, shrink, c1 : float
        Exponent of the objective; first step, factor and slope share of the line search.
    cuts : int
        Most cuts of a step.
    """
    widest = 0
    for k in range(nodes.size):
        widest = max(widest, start[nodes[k] + 1] - start[nodes[k]])
    blocks = patch.blocks_of(widest)
    for g in range(groups.size - 1):
        count = groups[g + 1] - groups[g]
        for chunk in numba.prange((count + _CHUNK - 1) // _CHUNK):
            table = np.empty(patch.TABLE * blocks)
            for k in range(groups[g] + chunk * _CHUNK, min(groups[g + 1], groups[g] + (chunk + 1) * _CHUNK)):
                i = nodes[k]
                begin, size = start[i], start[i + 1] - start[i]
                patch.load(points, hexes, corners, begin, size, table)
                scale = patch.rescale(table, size)  # delta is meant for edges of mean length 1
                if scale == 0:
                    continue
                patch.tabulate(table, size, delta)
                f, gx, gy, gz = patch.value_and_gradient(table, size, delta, p)
                if not 0 < f < np.inf or (gx == 0 and gy == 0 and gz == 0):
                    continue
                dx, dy, dz = 0.0, 0.0, 0.0
                if direction != STEEPEST_DESCENT:
                    dx, dy, dz = newton(patch.hessian(table, size, p), gx, gy, gz, direction == MODIFIED_NEWTON)
                slope = gx * dx + gy * dy + gz * dz
                if not slope < 0:  # no direction of descent
                    dx, dy, dz = steepest_descent(f, gx, gy, gz, p)
                    slope = gx * dx + gy * dy + gz * dz
                alpha = back_line_search(table, size, delta, p, f, slope, dx, dy, dz, first, shrink, c1, cuts)
                points[i, 0] += alpha * dx / scale
                points[i, 1] += alpha * dy / scale
                points[i, 2] += alpha * dz / scale
