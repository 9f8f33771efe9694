"""Interpolation of coordinates that are not finite."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.terminal_text import count_phrase


def interpolate_missing(points: np.ndarray, hexes: Sequence[np.ndarray]) -> tuple[np.ndarray, str]:
    """Place nodes without finite coordinates at the mean of their neighbours, layer by layer from known nodes.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : sequence of (k, 8), (k, 20) or (k, 27) int array
        Nodes of hexes of first or second order.

    Returns
    -------
    points : (n, 3) float64
        A copy. Nodes without any connection to a known one are at the mean of all known nodes.
    note : str
        A sentence for the notes of the mesh.
    """
    points = np.array(points, dtype=np.float64)
    known = np.isfinite(points).all(axis=1)
    missing = int(np.count_nonzero(~known))
    edges = np.concatenate([nodes[:, pair] for nodes in hexes for pair in _neighbours(nodes.shape[1])])
    edges = np.concatenate([edges, edges[:, ::-1]])
    points[~known] = points[known].mean(axis=0) if known.any() else 0.0
    while not known.all():
        front = edges[~known[edges[:, 0]] & known[edges[:, 1]]]
        if not len(front):
            break
        total = np.zeros_like(points)
        np.add.at(total, front[:, 0], points[front[:, 1]])
        count = np.bincount(front[:, 0], minlength=len(points))
        found = np.flatnonzero(count)
        points[found] = total[found] / count[found, None]
        known[found] = True
    return points, f"{count_phrase(missing, 'node')} had no finite coordinates: placed between their neighbours."


def _neighbours(width: int) -> list[tuple[int, int]]:
    """Pairs of adjacent nodes of a hex with `width` nodes: edges, and each mid-node with the corners around it."""
    edges = [(int(a), int(b)) for a, b in EDGES]
    return edges + [(k, int(corner)) for k in range(8, width) for corner in np.flatnonzero(MID_NODE_WEIGHTS[k - 8])]
