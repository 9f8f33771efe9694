"""In what order a sweep visits the free nodes, 5.2.6.

"Since the mesh boundary is fixed, information propagates from it to the mesh interior": a sweep may follow it, go
against it, or take no notice.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.quality import measure

#: The free nodes in the order of a sweep, (k,) int32: of the places of all nodes (n, 3) as it begins, and its number
#: from 0.
Sequence: TypeAlias = Callable[[np.ndarray, int], np.ndarray]


def colour(mesh: Mesh) -> Sequence:
    """Colour by colour, each by number."""
    return _always(mesh.topology.colouring(mesh.free).items)


def natural(mesh: Mesh) -> Sequence:
    """By number, as Algorithms 3.1 and 3.2 write it."""
    return _always(_free(mesh))


def reverse(mesh: Mesh) -> Sequence:
    """By number, the last first."""
    return _always(_free(mesh)[::-1].copy())


def random(mesh: Mesh) -> Sequence:
    """By chance, anew in each sweep; its number is the seed, so that a run can be done again."""
    nodes = _free(mesh)
    return lambda points, sweep: np.random.default_rng(sweep).permutation(nodes)


def inward(mesh: Mesh) -> Sequence:
    """Level by level from the fixed nodes, each by number."""
    return _always(_by_level(mesh))


def outward(mesh: Mesh) -> Sequence:
    """The way back: the nodes farthest from the fixed ones first."""
    return _always(_by_level(mesh)[::-1].copy())


def alternating(mesh: Mesh) -> Sequence:
    """Inward and outward in turn."""
    there = _by_level(mesh)
    both = there, there[::-1].copy()
    return lambda points, sweep: both[sweep % 2]


def worst_first(mesh: Mesh) -> Sequence:
    """By the least q(H) of the hexes at each node as the sweep begins, the worst first."""
    nodes, corners = _free(mesh), mesh.topology.node_corners
    start = corners.start[:-1][mesh.topology.used]

    def sequence(points: np.ndarray, sweep: int) -> np.ndarray:
        least = np.empty(mesh.n_nodes)
        least[mesh.topology.used] = np.minimum.reduceat(measure(points, mesh.hexes).q[corners.items // 8], start)
        return nodes[np.argsort(least[nodes], kind="stable")]

    return sequence


#: Orders by the name that a method's parameter gives.
ORDERS: dict[str, Callable[[Mesh], Sequence]] = {
    "colour": colour,
    "natural": natural,
    "reverse": reverse,
    "random": random,
    "inward": inward,
    "outward": outward,
    "alternating": alternating,
    "worst-first": worst_first,
}


class Visits:
    """Whom the sweeps over a mesh visit, and who can be visited at the same time.

    Parameters
    ----------
    mesh : Mesh
    order : str
        One of `ORDERS`.
    """

    def __init__(self, mesh: Mesh, order: str):
        self.sequence = ORDERS[order](mesh)
        self._mesh = mesh
        self._nodes: np.ndarray | None = None
        self._groups: CSR | None = None

    def groups(self, points: np.ndarray, sweep: int) -> CSR:
        """The nodes of a sweep in groups that share no hex: one group after another does what the sequence does.

        Parameters
        ----------
        points : (n, 3) float64
            Where the nodes are as the sweep begins.
        sweep : int
            Its number, from 0.
        """
        nodes = self.sequence(points, sweep)
        if nodes is not self._nodes:
            self._nodes, self._groups = nodes, self._mesh.topology.wavefronts(nodes)
        return self._groups


def _always(nodes: np.ndarray) -> Sequence:
    return lambda points, sweep: nodes


def _free(mesh: Mesh) -> np.ndarray:
    return np.flatnonzero(mesh.free).astype(np.int32)


def _by_level(mesh: Mesh) -> np.ndarray:
    nodes = _free(mesh)
    return nodes[np.argsort(mesh.topology.levels(mesh.fixed)[nodes], kind="stable")]
