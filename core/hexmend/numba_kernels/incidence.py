"""Who touches whom: nodes and hexes, faces, edges, colours. All linear in the number of hexes."""

from __future__ import annotations

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA, FACES
from hexmend.numba_kernels import serial

#: Of each corner, the three corners that it shares an edge with.
_EDGE_NEIGHBOURS = np.ascontiguousarray(CORNER_TETRAHEDRA[:, 1:])


@serial
def node_corners(hexes, n):
    """Corners of hexes at each node, as compressed rows.

    Parameters
    ----------
    hexes : (m, 8) int32
    n : int
        Number of nodes.

    Returns
    -------
    start : (n + 1,) int32
        Row i is corners[start[i]:start[i + 1]].
    corners : (8 m,) int32
        8 * hex + corner, ascending within a row.
    """
    start = np.zeros(n + 1, np.int32)
    for h in range(hexes.shape[0]):
        for c in range(8):
            start[hexes[h, c] + 1] += 1
    for i in range(n):
        start[i + 1] += start[i]
    place = start[:-1].copy()
    corners = np.empty(hexes.size, np.int32)
    for h in range(hexes.shape[0]):
        for c in range(8):
            i = hexes[h, c]
            corners[place[i]] = 8 * h + c
            place[i] += 1
    return start, corners


@serial
def _sorted_face(hexes, face, key):
    """Write the four nodes of face 6 h + f into `key`, ascending."""
    h, f = face // 6, face % 6
    for k in range(4):
        v = hexes[h, FACES[f, k]]
        j = k
        while j > 0 and key[j - 1] > v:
            key[j] = key[j - 1]
            j -= 1
        key[j] = v


@serial
def face_neighbours(hexes, n):
    """The hex behind each face.

    Faces are put in buckets by their lowest node; within a bucket (a dozen faces) those of equal nodes are paired.

    Returns
    -------
    neighbours : (m, 6) int32
        Hex on the other side; -1 where there is none, or where more than two hexes share the face.
    crowded : int
        Faces (counted once a hex) that more than two hexes share: a defect of the mesh.
    """
    m = hexes.shape[0]
    key, other = np.empty(4, np.int32), np.empty(4, np.int32)
    start = np.zeros(n + 1, np.int32)
    for face in range(6 * m):
        _sorted_face(hexes, face, key)
        start[key[0] + 1] += 1
    for i in range(n):
        start[i + 1] += start[i]
    place = start[:-1].copy()
    bucket = np.empty(6 * m, np.int32)
    for face in range(6 * m):
        _sorted_face(hexes, face, key)
        bucket[place[key[0]]] = face
        place[key[0]] += 1

    neighbours = np.full((m, 6), -1, np.int32)
    crowded = 0
    for i in range(n):
        for s in range(start[i], start[i + 1]):
            face = bucket[s]
            _sorted_face(hexes, face, key)
            partner, met = -1, 0
            for t in range(start[i], start[i + 1]):
                if t != s:
                    _sorted_face(hexes, bucket[t], other)
                    if key[1] == other[1] and key[2] == other[2] and key[3] == other[3]:
                        partner = bucket[t] // 6
                        met += 1
            if met == 1:
                neighbours[face // 6, face % 6] = partner
            elif met > 1:
                crowded += 1
    return neighbours, crowded


@serial
def _root(parent, i):
    """The node that stands for the part of node i; the way there is halved for those who come after."""
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@serial
def parts(hexes, used):
    """How many parts, hanging together by nodes, the used nodes (n,) bool are in."""
    parent = np.arange(used.size)
    for h in range(hexes.shape[0]):
        first = _root(parent, hexes[h, 0])
        for c in range(1, 8):
            other = _root(parent, hexes[h, c])
            parent[max(first, other)] = first = min(first, other)
    count = 0
    for i in range(used.size):
        count += used[i] and parent[i] == i
    return count


@serial
def node_rings(hexes, start, corners):
    """Edge neighbours of each node, as compressed rows, ascending.

    Returns
    -------
    ring_start : (n + 1,) int32
    ring : (sum of ring sizes,) int32
    """
    n = start.size - 1
    widest = 0
    for i in range(n):
        widest = max(widest, start[i + 1] - start[i])
    row = np.empty(3 * widest + 1, np.int32)
    ring_start = np.zeros(n + 1, np.int32)
    ring = np.empty(0, np.int32)
    for fill in range(2):  # count, then write
        if fill == 1:
            for i in range(n):
                ring_start[i + 1] += ring_start[i]
            ring = np.empty(ring_start[n], np.int32)
        for i in range(n):
            size = 0
            for s in range(start[i], start[i + 1]):
                h, c = corners[s] // 8, corners[s] % 8
                for k in range(3):
                    v = hexes[h, _EDGE_NEIGHBOURS[c, k]]
                    j = size
                    while j > 0 and row[j - 1] > v:
                        j -= 1
                    if v != i and (j == 0 or row[j - 1] != v):
                        for t in range(size, j, -1):
                            row[t] = row[t - 1]
                        row[j] = v
                        size += 1
            if fill == 0:
                ring_start[i + 1] = size
            else:
                for j in range(size):
                    ring[ring_start[i] + j] = row[j]
    return ring_start, ring


@serial
def greedy_colours(hexes, start, corners, chosen):
    """Colour the chosen nodes so that two of one hex never share a colour; greedy in node order.

    Returns
    -------
    colour : (n,) int32
        -1 for nodes that were not chosen.
    """
    n = start.size - 1
    widest = 0
    for i in range(n):
        widest = max(widest, start[i + 1] - start[i])
    colour = np.full(n, -1, np.int32)
    taken_by = np.full(7 * widest + 2, -1, np.int32)  # the node that last saw a colour taken
    for i in range(n):
        if chosen[i]:
            for s in range(start[i], start[i + 1]):
                h = corners[s] // 8
                for c in range(8):
                    k = colour[hexes[h, c]]
                    if k >= 0:
                        taken_by[k] = i
            k = 0
            while taken_by[k] == i:
                k += 1
            colour[i] = k
    return colour


@serial
def grouped(colour, count):
    """Nodes grouped by colour, each group in node order: (start (count + 1,), nodes)."""
    start = np.zeros(count + 1, np.int32)
    for i in range(colour.size):
        if colour[i] >= 0:
            start[colour[i] + 1] += 1
    for k in range(count):
        start[k + 1] += start[k]
    place = start[:-1].copy()
    nodes = np.empty(start[count], np.int32)
    for i in range(colour.size):
        k = colour[i]
        if k >= 0:
            nodes[place[k]] = i
            place[k] += 1
    return start, nodes


@serial
def layers(neighbours):
    """How many hexes lie between each hex and the boundary, counted through faces: breadth first.

    Parameters
    ----------
    neighbours : (m, 6) int32
        From `face_neighbours`.

    Returns
    -------
    layer : (m,) int32
        0 for a hex with a boundary face; one more than the deepest layer where no way leads to the boundary.
    """
    m = neighbours.shape[0]
    layer = np.full(m, -1, np.int32)
    queue = np.empty(m, np.int32)
    end = 0
    for h in range(m):
        for f in range(6):
            if neighbours[h, f] < 0:
                layer[h] = 0
        if layer[h] == 0:
            queue[end] = h
            end += 1
    deepest = -1
    at = 0
    while at < end:
        h = queue[at]
        at += 1
        deepest = layer[h]
        for f in range(6):
            other = neighbours[h, f]
            if other >= 0 and layer[other] < 0:
                layer[other] = deepest + 1
                queue[end] = other
                end += 1
    if end < m:
        for h in range(m):
            if layer[h] < 0:
                layer[h] = deepest + 1
    return layer


@serial
def around(hexes, start, corners, chosen, rings):
    """The chosen hexes and those that are reached from them in so many steps from hex to hex through a common node.

    Parameters
    ----------
    hexes : (m, 8) int32
    start, corners
        From `node_corners`.
    chosen : (k,) int32
    rings : int

    Returns
    -------
    reached : (m,) bool
    """
    m, n = hexes.shape[0], start.size - 1
    reached, seen = np.zeros(m, np.bool_), np.zeros(n, np.bool_)
    queue = np.empty(m, np.int32)
    end = 0
    for h in chosen:
        if not reached[h]:
            reached[h] = True
            queue[end] = h
            end += 1
    at = 0
    for _ in range(rings):
        last = end
        while at < last:
            h = queue[at]
            at += 1
            for c in range(8):
                i = hexes[h, c]
                if not seen[i]:
                    seen[i] = True
                    for s in range(start[i], start[i + 1]):
                        other = corners[s] // 8
                        if not reached[other]:
                            reached[other] = True
                            queue[end] = other
                            end += 1
    return reached
