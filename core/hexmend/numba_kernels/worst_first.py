"""The second stage of GETMe: the worst hex takes its step, again and again, from a priority queue."""

from __future__ import annotations

import numpy as np

from hexmend.numba_kernels import serial
from hexmend.numba_kernels.element_step import element_step
from hexmend.numba_kernels.elements import load, quality

# The queue is a tournament: a binary tree, kept in an array, with the hexes as leaves and in each node the one of its
# two children that has the lesser key. The root, number 1, is the hex of least key; a changed key replays the matches
# on the way from its leaf to the root.


@serial
def _match(key, a, b):
    """The one of two hexes that has the lesser key; of equal ones, that of the lower number."""
    return a if key[a] < key[b] or (key[a] == key[b] and a < b) else b


@serial
def tournament(key, hexes):
    """The queue of some hexes; tree (2 k,) int32, the hex of least key at 1."""
    k = hexes.size
    tree = np.empty(2 * k, np.int32)
    for i in range(k):
        tree[k + i] = hexes[i]
    for i in range(k - 1, 0, -1):
        tree[i] = _match(key, tree[2 * i], tree[2 * i + 1])
    return tree


@serial
def replay(tree, key, leaf):
    """Set the queue right after the key of the hex at a leaf has changed."""
    i = tree.size // 2 + leaf
    h = tree[i]
    while i > 1:
        i //= 2
        winner = _match(key, tree[2 * i], tree[2 * i + 1])
        if winner == tree[i] != h:
            break  # h neither won this match nor wins it now: all above stands
        tree[i] = winner


@serial
def sweep(points, hexes, start, corners, free, candidates, q, sound, s, rho, penalty, setback):
    """As many element steps as there are candidates, each of the hex that is worst at the time.

    A step that would invert a sound hex is taken back. The hex that took a step pays a penalty, lest it be chosen for
    ever: it counts as better by `penalty` where the step was kept, by `setback` where it was taken back. The points end
    at the best state on the way: fewest inverted hexes, then highest q_min, then highest q_mean.

    Parameters
    ----------
    points : (n, 3) float64, changed
    start, corners
        `Topology.node_corners`.
    free : (n,) bool
    candidates : (k,) int32
        The hexes that have a free node.
    q : (m,) float64, changed
    sound : (m,) bool, changed
        Both as measured at `points`; afterwards those of the last state, which need not be the best.

    Returns
    -------
    int
        Steps taken back.
    """
    m, steps = hexes.shape[0], candidates.size
    if steps == 0:  # a queue of nothing has no first
        return 0
    key = q.copy()
    for h in range(m):
        key[h] -= not sound[h]  # inverted hexes come first
    leaf = np.full(m, -1, np.int32)
    for i in range(steps):
        leaf[candidates[i]] = i
    turn, least = tournament(key, candidates), tournament(q, candidates)
    best, gain, best_gain, mended = q[least[1]], 0.0, 0.0, False

    widest = 0
    for i in range(start.size - 1):
        widest = max(widest, start[i + 1] - start[i])
    touched, q_after, sound_after = np.empty(8 * widest, np.int32), np.empty(8 * widest), np.empty(8 * widest, np.bool_)
    touched_in = np.full(m, -1, np.int32)
    x, y, f = np.empty((8, 3)), np.empty((8, 3)), np.empty((6, 3))
    # What was moved since the best state, and from where.
    undo_node, undo_place, undo = np.empty(8 * steps, np.int32), np.empty((8 * steps, 3)), 0
    taken_back = 0

    for step in range(steps):
        h = turn[1]
        load(points, hexes, h, x)
        element_step(x, s, rho, f, y)
        first_undo, count = undo, 0
        for c in range(8):
            i = hexes[h, c]
            if not free[i]:
                continue
            undo_node[undo] = i
            for k in range(3):
                undo_place[undo, k] = points[i, k]
                points[i, k] = y[c, k]
            undo += 1
            for r in range(start[i], start[i + 1]):
                g = corners[r] // 8
                if touched_in[g] != step:
                    touched_in[g] = step
                    touched[count] = g
                    count += 1
        harm = False
        for r in range(count):
            load(points, hexes, touched[r], x)
            q_after[r], sound_after[r] = quality(x)
            if sound[touched[r]] and not sound_after[r]:
                harm = True
                break
        if harm:
            taken_back += 1
            undo = _back(points, undo_node, undo_place, undo, first_undo)
            key[h] += setback
            replay(turn, key, leaf[h])
            continue
        key[h] += penalty
        for r in range(count):
            g = touched[r]
            rise = q_after[r] - q[g]
            gain += rise
            key[g] += rise
            q[g] = q_after[r]
            if sound_after[r] and not sound[g]:
                sound[g] = mended = True
                key[g] += 1
            replay(turn, key, leaf[g])
            replay(least, q, leaf[g])
        now = q[least[1]]
        if mended or now > best or (now == best and gain > best_gain):
            best, best_gain, mended, undo = now, gain, False, 0
    _back(points, undo_node, undo_place, undo, 0)
    return taken_back


@serial
def _back(points, undo_node, undo_place, undo, to):
    """Undo moves down to number `to`, the latest first; returns `to`."""
    while undo > to:
        undo -= 1
        for k in range(3):
            points[undo_node[undo], k] = undo_place[undo, k]
    return to
