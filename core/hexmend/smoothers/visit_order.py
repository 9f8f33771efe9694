"""Orders in which a sweep visits the free nodes (Wilson 5.2.6).

"Since the mesh boundary is fixed, information propagates from it to the mesh interior": a sweep may follow it or go
against it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.quality.measure import measure

#: Function of the points (n, 3) at the beginning of a sweep and of its number, from 0, that gives the free nodes in the
#: order of the sweep, (k,) int32.
Sequence: TypeAlias = Callable[[np.ndarray, int], np.ndarray]


def _constant(nodes: np.ndarray) -> Sequence:
    return lambda points, sweep: nodes


def _free_nodes(mesh: Mesh) -> np.ndarray:
    return np.flatnonzero(mesh.free).astype(np.int32)


def _by_level(mesh: Mesh) -> np.ndarray:
    """Free nodes level by level from the fixed ones, each level by number."""
    nodes = _free_nodes(mesh)
    return nodes[np.argsort(mesh.topology.levels(mesh.fixed)[nodes], kind="stable")]


def random(mesh: Mesh) -> Sequence:
    """Random in each sweep, whose number is the seed: runs can be repeated."""
    nodes = _free_nodes(mesh)
    return lambda points, sweep: np.random.default_rng(sweep).permutation(nodes)


def alternating(mesh: Mesh) -> Sequence:
    """Inward and outward in turns."""
    inwards = _by_level(mesh)
    both = inwards, inwards[::-1].copy()
    return lambda points, sweep: both[sweep % 2]


def worst_first(mesh: Mesh) -> Sequence:
    """By the least q(H) of the hexes at each node as the sweep begins, the worst first."""
    nodes, corners = _free_nodes(mesh), mesh.topology.node_corners
    start = corners.start[:-1][mesh.topology.used]

    def sequence(points: np.ndarray, sweep: int) -> np.ndarray:
        least = np.empty(mesh.n_nodes)
        least[mesh.topology.used] = np.minimum.reduceat(measure(points, mesh.elements).q[corners.items // 8], start)
        return nodes[np.argsort(least[nodes], kind="stable")]

    return sequence


#: Orders by the value of a method's parameter.
ORDERS: dict[str, Callable[[Mesh], Sequence]] = {
    "colour": lambda mesh: _constant(mesh.topology.colouring(mesh.free).items),  # each colour by number
    "natural": lambda mesh: _constant(_free_nodes(mesh)),  # as in Algorithms 3.1 and 3.2
    "reverse": lambda mesh: _constant(_free_nodes(mesh)[::-1].copy()),
    "random": random,
    "inward": lambda mesh: _constant(_by_level(mesh)),
    "outward": lambda mesh: _constant(_by_level(mesh)[::-1].copy()),
    "alternating": alternating,
    "worst-first": worst_first,
}


class VisitOrder:
    """Order of the nodes in the sweeps over a mesh, in groups that can be visited at the same time.

    Parameters
    ----------
    mesh : Mesh
    order : str
        One of `ORDERS`.
    steps : int
        Times that a node is visited before the next (3.2.2).
    """

    def __init__(self, mesh: Mesh, order: str, steps: int = 1):
        self.sequence = ORDERS[order](mesh)
        self._mesh, self._steps = mesh, steps
        self._nodes: np.ndarray | None = None
        self._groups: CSR | None = None

    def groups(self, points: np.ndarray, sweep: int) -> CSR:
        """Group the nodes of a sweep so that nodes of a group share no hex; the result equals the sequence's.

        Parameters
        ----------
        points : (n, 3) float64
            At the beginning of the sweep.
        sweep : int
            Its number, from 0.

        Returns
        -------
        CSR
            A row of nodes for each group.
        """
        nodes = self.sequence(points, sweep)
        if nodes is not self._nodes or self._groups is None:
            self._nodes, self._groups = nodes, self._mesh.topology.wavefronts(nodes.repeat(self._steps))
        return self._groups
