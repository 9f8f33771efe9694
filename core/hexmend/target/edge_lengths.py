"""Lengths of hexes along their own three directions, and the numbers of their twelve edges."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.edge_length import hex_lengths
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import kinds_of
from hexmend.mesh.topology import Topology

#: Shortest length, as a share of the mean edge length: a direction without any extent gets it.
_LEAST = 1e-12


def given_lengths(mesh: Mesh, which: np.ndarray | None = None) -> np.ndarray:
    """Compute the lengths of cells along the edges of their corners: see `hexmend.mesh.edge_length.hex_lengths`.

    Lengths of edges are positive, however a hex is distorted or inverted.

    Parameters
    ----------
    mesh : Mesh
    which : (k,) int, optional
        Numbers of hexes; all by default.

    Returns
    -------
    (k, 3) float64
        In the mesh's unit of length, positive.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> given_lengths(Mesh(UNIT_CUBE * [1, 2, 3], [range(8)]))
    array([[1., 2., 3.]])
    """
    lengths = hex_lengths(mesh.points, mesh.elements if which is None else mesh.elements[which])
    return np.maximum(lengths, _LEAST * (mesh.mean_edge_length or 1.0), out=lengths)


def edge_numbers(topology: Topology) -> np.ndarray:
    """Find the number, in `Topology.edges`, of each edge of each hex.

    Parameters
    ----------
    topology : Topology

    Returns
    -------
    (m, 12) int32
        Columns as of `hexmend.mesh.hexahedron.EDGES`; -1 for an edge whose two nodes are one, and in the rows of other
        cells.
    """
    edges, hexes = topology.edges, topology.elements
    start = np.concatenate([[0], np.cumsum(np.bincount(edges[:, 0], minlength=topology.n))])
    most = int(np.diff(start).max(initial=0))
    upper = np.concatenate([edges[:, 1], np.full(most, -1, np.int32)])  # the upper ends at a node ascend
    numbers = np.empty((len(hexes), len(EDGES)), np.int32)
    for column, (a, b) in enumerate(EDGES):
        low, high = np.minimum(hexes[:, a], hexes[:, b]), np.maximum(hexes[:, a], hexes[:, b])
        at = start[low]
        for _ in range(1, most):
            at += upper[at] < high
        numbers[:, column] = np.where(low == high, -1, at)
    numbers[kinds_of(hexes) > 0] = -1
    return numbers
