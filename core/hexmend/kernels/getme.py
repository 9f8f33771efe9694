"""GETMe: each hex takes a regularising step of its own; nodes go to means of the places their hexes give them.

Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
"""

from __future__ import annotations

import numba
import numpy as np

from hexmend.hexahedron import EDGES, FACES, UNIT_CUBE
from hexmend.kernels import CHUNK, parallel, serial
from hexmend.kernels.elements import load, quality

#: Halvings of a node's step before it is given up: 1, 1/2, 1/4, 1/8, 0.
HALVINGS = 4


def _corner_faces() -> np.ndarray:
    side = UNIT_CUBE.astype(np.int64)
    faces = side + [0, 2, 4]  # FACES is x-, x+, y-, y+, z-, z+
    mirrored = side.sum(axis=1) % 2 == 0
    faces[mirrored, 1:] = faces[mirrored, :0:-1]
    return faces


#: The three faces (i, j, k) that meet at each corner, (8, 3): the normal of their centroids' triangle points outward.
CORNER_FACES = _corner_faces()


@serial
def _mean_edge(x):
    total = 0.0
    for e in range(12):
        a, b = EDGES[e, 0], EDGES[e, 1]
        dx, dy, dz = x[b, 0] - x[a, 0], x[b, 1] - x[a, 1], x[b, 2] - x[a, 2]
        total += np.sqrt(dx * dx + dy * dy + dz * dz)
    return total / 12


@serial
def element_step(x, s, rho, f, y):
    """The hex x (8, 3) after one step towards the cube; writes y (8, 3), uses f (6, 3).

    Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and normal of a triangle of the dual octahedron; the hex is
    scaled about its centroid to its old mean edge length and blended with the old one by rho.
    """
    for i in range(6):
        for k in range(3):
            f[i, k] = (x[FACES[i, 0], k] + x[FACES[i, 1], k] + x[FACES[i, 2], k] + x[FACES[i, 3], k]) / 4
    mx, my, mz = 0.0, 0.0, 0.0
    for c in range(8):
        i, j, k = CORNER_FACES[c, 0], CORNER_FACES[c, 1], CORNER_FACES[c, 2]
        ux, uy, uz = f[j, 0] - f[i, 0], f[j, 1] - f[i, 1], f[j, 2] - f[i, 2]
        vx, vy, vz = f[k, 0] - f[i, 0], f[k, 1] - f[i, 1], f[k, 2] - f[i, 2]
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        root = np.sqrt(np.sqrt(nx * nx + ny * ny + nz * nz))
        along = s / root if root > 0 else 0.0
        y[c, 0] = (f[i, 0] + f[j, 0] + f[k, 0]) / 3 + along * nx
        y[c, 1] = (f[i, 1] + f[j, 1] + f[k, 1]) / 3 + along * ny
        y[c, 2] = (f[i, 2] + f[j, 2] + f[k, 2]) / 3 + along * nz
        mx += y[c, 0] / 8
        my += y[c, 1] / 8
        mz += y[c, 2] / 8
    length = _mean_edge(y)
    zeta = _mean_edge(x) / length if length > 0 else 0.0
    for c in range(8):
        y[c, 0] = x[c, 0] + rho * (mx + zeta * (y[c, 0] - mx) - x[c, 0])
        y[c, 1] = x[c, 1] + rho * (my + zeta * (y[c, 1] - my) - x[c, 1])
        y[c, 2] = x[c, 2] + rho * (mz + zeta * (y[c, 2] - mz) - x[c, 2])


@parallel
def element_steps(points, hexes, s, rho, places):
    """`element_step` of every hex; writes places (m, 8, 3)."""
    m = hexes.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        x, f = np.empty((8, 3)), np.empty((6, 3))
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            load(points, hexes, h, x)
            element_step(x, s, rho, f, places[h])


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
    queue[:queued] = harmed
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
