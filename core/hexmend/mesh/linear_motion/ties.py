"""Ties between nodes: chains and cycles of them become ties to one node each."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.mesh.linear_motion.subspaces import TOLERANCE, fixed_spaces, rounded
from hexmend.mesh.topology.components import components


def resolved(tied: np.ndarray, master: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, ...]:
    """Resolve chains and cycles of ties, as at an edge of a box that is periodic in two directions.

    A node that is tied to itself by a rotation, as on the axis of a wedge, may move along the axis.

    Parameters
    ----------
    tied, master : (t,) int
        A node can be tied several times, to nodes that are tied themselves, and to itself.
    rotations : (t, 3, 3) float64

    Returns
    -------
    tied, master : (t,) int32
        Each tied node once, ascending, and the node that it follows, which is not tied itself: of connected nodes the
        lowest that is not tied, or else the lowest.
    rotations : (t, 3, 3) float64
        The displacement of tied[i] is rotations[i] times that of master[i].
    nodes : (k,) int32
        Masters whose displacement a cycle of ties restricts; one can be there several times.
    projectors : (k, 3, 3) float64
        Projectors onto their admissible displacements.
    """
    nodes, ends = np.unique(np.concatenate([tied, master]), return_inverse=True)
    tied, master = ends[: tied.size], ends[tied.size :]
    # The root of a node is the lowest of its component that is not tied, or else the lowest.
    component = components(nodes.size, np.column_stack([tied, master]))
    order = np.lexsort((np.arange(nodes.size), mask(tied, nodes.size), component))
    _, first = np.unique(component[order], return_index=True)
    root = order[first][component]
    turn = np.tile(np.eye(3), (nodes.size, 1, 1))  # the displacement of a node is `turn` times that of its root
    known = root == np.arange(nodes.size)
    while not known.all():
        down, up = known[master] & ~known[tied], known[tied] & ~known[master]
        turn[tied[down]] = rotations[down] @ turn[master[down]]
        turn[master[up]] = rotations[up].transpose(0, 2, 1) @ turn[tied[up]]
        known[tied[down]] = known[master[up]] = True
    cycle = turn[tied].transpose(0, 2, 1) @ rotations @ turn[master]
    bent = np.flatnonzero((np.abs(cycle - np.eye(3)) > TOLERANCE).any(axis=(1, 2)))
    follows = np.flatnonzero(root != np.arange(nodes.size))
    return (
        nodes[follows].astype(np.int32),
        nodes[root[follows]].astype(np.int32),
        rounded(turn[follows]),
        nodes[root[tied[bent]]].astype(np.int32),
        fixed_spaces(cycle[bent]),
    )
