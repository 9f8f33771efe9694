"""How many hexes meet in an edge: what tells where the blocks of a mesh join."""

from __future__ import annotations

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA, FACES
from hexmend.numba_kernels import serial

#: Of each corner, the three corners that it shares an edge with, (8, 3).
_ENDS = np.ascontiguousarray(CORNER_TETRAHEDRA[:, 1:])

#: The two faces that meet in each of these edges, (8, 3, 2).
_SIDES = np.array([[[f for f in range(6) if a in FACES[f] and b in FACES[f]] for b in _ENDS[a]] for a in range(8)])


@serial
def edges(hexes, start, corners, neighbours):
    """Every edge once, with the number of hexes around it.

    Parameters
    ----------
    hexes : (m, 8) int32
    start, corners
        From `incidence.node_corners`.
    neighbours : (m, 6) int32
        From `incidence.face_neighbours`.

    Returns
    -------
    ends : (e, 2) int32
        Lower node first, ascending.
    valence : (e,) int32
        Hexes that have the edge; a hex that has it twice, its nodes being one, counts once.
    outside : (e,) bool
        True for an edge of a boundary face.
    """
    room = 12 * hexes.shape[0]  # memory that is not written to is not taken
    ends, valence = np.empty((room, 2), np.int32), np.empty(room, np.int32)
    outside, last = np.empty(room, np.bool_), np.empty(room, np.int32)
    end = 0
    for i in range(start.size - 1):
        begin = end
        for s in range(start[i], start[i + 1]):
            h, c = corners[s] // 8, corners[s] % 8
            for k in range(3):
                v = hexes[h, _ENDS[c, k]]
                if v <= i:
                    continue
                j = end
                while j > begin and ends[j - 1, 1] > v:
                    j -= 1
                if j > begin and ends[j - 1, 1] == v:
                    j -= 1
                else:
                    for t in range(end, j, -1):
                        ends[t, 1], valence[t] = ends[t - 1, 1], valence[t - 1]
                        outside[t], last[t] = outside[t - 1], last[t - 1]
                    ends[j, 1], valence[j], outside[j], last[j] = v, 0, False, -1
                    end += 1
                valence[j] += last[j] != h
                last[j] = h
                outside[j] |= neighbours[h, _SIDES[c, k, 0]] < 0 or neighbours[h, _SIDES[c, k, 1]] < 0
        ends[begin:end, 0] = i
    return ends[:end].copy(), valence[:end].copy(), outside[:end].copy()
