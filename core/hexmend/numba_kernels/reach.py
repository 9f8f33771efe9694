"""How far the nodes may go in one step."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import CHUNK, parallel


@parallel
def shorten(step, points, ring_start, ring, nodes, reach):
    """Shorten the steps of nodes that are longer than `reach` mean lengths of their edges.

    Parameters
    ----------
    step : (k, 3) float64, changed
    points : (n, 3) float64
    ring_start, ring
        `Topology.rings`.
    nodes : (k,) int32
    reach : float
    """
    for chunk in numba.prange((nodes.size + CHUNK - 1) // CHUNK):
        for k in range(chunk * CHUNK, min(nodes.size, (chunk + 1) * CHUNK)):
            i = nodes[k]
            total = 0.0
            for s in range(ring_start[i], ring_start[i + 1]):
                j = ring[s]
                dx, dy, dz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
                total += np.sqrt(dx * dx + dy * dy + dz * dz)
            furthest = reach * total / (ring_start[i + 1] - ring_start[i])
            length = np.sqrt(step[k, 0] ** 2 + step[k, 1] ** 2 + step[k, 2] ** 2)
            if length > furthest:
                for c in range(3):
                    step[k, c] *= furthest / length
