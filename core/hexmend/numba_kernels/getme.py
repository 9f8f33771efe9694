"""GETMe: nodes go to means of the places that their hexes give them.

Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import parallel, serial
from hexmend.numba_kernels.elements import load, quality

#: Halvings of a node's step before it is given up: 1, 1/2, 1/4, 1/8, 0.
HALVINGS = 4


@parallel
def weighted_means(places, weights, start, corners, nodes, targets):
    """Write, for each of `nodes`, the mean of its places in its hexes by the hexes' weights (m,); targets (n, 3)."""
    for k in numba.prange(nodes.size):
        i = nodes[k]
        total, tx, ty, tz = 0.0, 0.0, 0.0, 0.0
        for j in range(start[i], start[i + 1]):
            h, c = corners[j] // 8, corners[j] % 8
            w = weights[h]
            total += w
            tx += w * places[h, c, 0]
            ty += w * places[h, c, 1]
            tz += w * places[h, c, 2]
        targets[i, 0], targets[i, 1], targets[i, 2] = tx / total, ty / total, tz / total


@serial
def relax(points, hexes, start, corners, sound, harmed, moved):
    """Shorten the moves of nodes until no hex that was sound is inverted.

    Round after round, the nodes of all inverted hexes halve their moves, the fourth time to nothing; a hex none of
    whose nodes moves is what it was, so the rounds end.

    Parameters
    ----------
    points : (n, 3) float64
        Before the move.
    sound : (m,) bool
        Whether a hex was sound at `points`.
    harmed : (k,) int32
        Hexes that are not sound any more at `moved`.
    moved : (n, 3) float64, changed

    Returns
    -------
    int
        Nodes whose moves were shortened.
    """
    level = np.zeros(points.shape[0], np.int8)
    step = moved.copy()
    node_round, hex_round = np.zeros(points.shape[0], np.int32), np.zeros(hexes.shape[0], np.int32)
    changed = np.empty(points.shape[0], np.int32)
    queue = np.empty(hexes.shape[0], np.int32)
    queued = harmed.size
    for j in range(queued):
        queue[j] = harmed[j]
    x = np.empty((8, 3))
    relaxed, this = 0, 0
    while queued:
        this += 1
        n_changed = 0
        for j in range(queued):
            for c in range(8):
                i = hexes[queue[j], c]
                if node_round[i] == this or level[i] == HALVINGS:
                    continue
                node_round[i] = this
                relaxed += level[i] == 0
                level[i] += 1
                share = 0.5 ** level[i] if level[i] < HALVINGS else 0.0
                for k in range(3):
                    moved[i, k] = points[i, k] + share * (step[i, k] - points[i, k])
                changed[n_changed] = i
                n_changed += 1
        queued = 0
        for j in range(n_changed):
            for r in range(start[changed[j]], start[changed[j] + 1]):
                h = corners[r] // 8
                if hex_round[h] == this or not sound[h]:
                    continue
                hex_round[h] = this
                load(moved, hexes, h, x)
                if not quality(x)[1]:
                    queue[queued] = h
                    queued += 1
    return relaxed
