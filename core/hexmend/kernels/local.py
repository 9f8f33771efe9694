"""One line-searched step per free node: a sweep of local optimisation, colour by colour."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.kernels import parallel, patch, serial

#: Nodes that one thread takes at a time.
_CHUNK = 64


@serial
def back_line_search(table, rest, size, delta, p, lane, f, gx, gy, gz, first, shrink, c1, cuts):
    """Algorithm A.5 along p_k = -gradient.

    Returns
    -------
    alpha : float
        The accepted step; 0 if none of `cuts` + 1 trials descends enough.
    """
    slope = -(gx * gx + gy * gy + gz * gz)
    alpha = first
    for _ in range(cuts + 1):
        trial = patch.value(table, rest, size, -alpha * gx, -alpha * gy, -alpha * gz, delta, p, lane)
        if trial < f + c1 * alpha * slope:
            return alpha
        alpha *= shrink
    return 0.0


@parallel
def steepest_descent_sweep(points, hexes, start, corners, groups, nodes, delta, p, first, shrink, c1, cuts):
    """Move every node of `nodes` once, in place.

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
    for g in range(groups.size - 1):
        count = groups[g + 1] - groups[g]
        for chunk in numba.prange((count + _CHUNK - 1) // _CHUNK):
            x = np.empty((8, 3))
            table = np.empty((9, 4 * widest))
            lane = np.empty((3, 4 * widest))
            rest = np.empty(widest)
            for k in range(groups[g] + chunk * _CHUNK, min(groups[g + 1], groups[g] + (chunk + 1) * _CHUNK)):
                i = nodes[k]
                begin, end = start[i], start[i + 1]
                size = end - begin
                scale = patch.scale_of(points, hexes, corners, begin, end)
                if scale == 0:
                    continue
                patch.tabulate(points, hexes, corners, begin, end, scale, delta, x, table, rest)
                f, gx, gy, gz = patch.value_and_gradient(table, rest, size, delta, p, lane)
                if gx == 0 and gy == 0 and gz == 0:
                    continue
                alpha = back_line_search(
                    table, rest, size, delta, p, lane, f, gx, gy, gz, first, shrink, c1, cuts
                )  # fmt: skip
                points[i, 0] -= alpha * gx / scale
                points[i, 1] -= alpha * gy / scale
                points[i, 2] -= alpha * gz / scale
