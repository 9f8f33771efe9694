"""Laplacian sweeps: a node goes to the mean of its edge neighbours."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import parallel, serial
from hexmend.numba_kernels.elements import load, quality


@serial
def ring_mean(points, ring_start, ring, i):
    """Mean of the edge neighbours of node i, (x, y, z)."""
    x, y, z = 0.0, 0.0, 0.0
    for s in range(ring_start[i], ring_start[i + 1]):
        x += points[ring[s], 0]
        y += points[ring[s], 1]
        z += points[ring[s], 2]
    count = ring_start[i + 1] - ring_start[i]
    return x / count, y / count, z / count


@serial
def in_place(points, ring_start, ring, nodes):
    """Algorithm 3.1: node after node, each seeing where those before it went; changes points (n, 3)."""
    for k in range(nodes.size):
        i = nodes[k]
        points[i, 0], points[i, 1], points[i, 2] = ring_mean(points, ring_start, ring, i)


@parallel
def simultaneous(points, ring_start, ring, nodes, moved):
    """All nodes at once, each seeing where the others were; writes moved (n, 3)."""
    for k in numba.prange(nodes.size):
        i = nodes[k]
        moved[i, 0], moved[i, 1], moved[i, 2] = ring_mean(points, ring_start, ring, i)


@serial
def _attached(points, hexes, corners, begin, end, x, sound, q):
    """Write, for each attached hex, whether no corner is inverted, and its q(H)."""
    for s in range(begin, end):
        load(points, hexes, corners[s] // 8, x)
        q[s - begin], sound[s - begin] = quality(x)


@serial
def guarded(points, hexes, start, corners, ring_start, ring, nodes, keep_least_quality):
    """Algorithm 3.1 in which a move that harms is taken back; changes points (n, 3).

    A move harms if it inverts an attached hex that was not inverted, or, with `keep_least_quality`, if it lowers the
    least q(H) of the attached hexes.

    Returns
    -------
    int
        Moves taken back.
    """
    widest = 0
    for k in range(nodes.size):
        widest = max(widest, start[nodes[k] + 1] - start[nodes[k]])
    x = np.empty((8, 3))
    sound, sound_after = np.empty(widest, np.bool_), np.empty(widest, np.bool_)
    q, q_after = np.empty(widest), np.empty(widest)
    taken_back = 0
    for k in range(nodes.size):
        i = nodes[k]
        begin, end = start[i], start[i + 1]
        _attached(points, hexes, corners, begin, end, x, sound, q)
        ox, oy, oz = points[i, 0], points[i, 1], points[i, 2]
        points[i, 0], points[i, 1], points[i, 2] = ring_mean(points, ring_start, ring, i)
        _attached(points, hexes, corners, begin, end, x, sound_after, q_after)
        harm = False
        least, least_after = np.inf, np.inf
        for s in range(end - begin):
            harm |= sound[s] and not sound_after[s]
            least, least_after = min(least, q[s]), min(least_after, q_after[s])
        if harm or (keep_least_quality and least_after < least):
            points[i, 0], points[i, 1], points[i, 2] = ox, oy, oz
            taken_back += 1
    return taken_back
