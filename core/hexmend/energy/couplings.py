"""Which free nodes are coupled by a mesh's energy, and in what order an assembled Hessian keeps them."""

from __future__ import annotations

import itertools

import numpy as np
import scipy.sparse
from scipy.sparse.csgraph import reverse_cuthill_mckee

from hexmend.kernels import couplings as kernels
from hexmend.mesh import Mesh

#: Slots are divided into parts that threads solve side by side: from so many slots on into 2, 4 and 8.
_PARTS = ((4_000, 2), (100_000, 4), (400_000, 8))


class Couplings:
    """Pattern of the blocks of a Hessian: free nodes in slots, neighbours near each other, and who shares a hex.

    Depends on the mesh alone, not on the number of threads.

    Parameters
    ----------
    mesh : Mesh
    part : int, optional
        Slots in a part; 1 makes the preconditioner block Jacobi.

    Attributes
    ----------
    nodes : (k,) int32
        The node in each slot.
    slots : (m, 8) int32
        Slot of each corner, -1 if it is fixed.
    target : (m, 28) int32
        The block that each pair of a hex's corners adds to.
    pattern : tuple
        What the kernels of `conjugate_gradients` begin with.
    """

    def __init__(self, mesh: Mesh, part: int | None = None):
        corners = mesh.topology.node_corners
        self.nodes = _near_each_other(mesh)
        slot = np.full(mesh.n_nodes, -1, np.int32)
        slot[self.nodes] = np.arange(self.nodes.size, dtype=np.int32)
        self.slots = slot[mesh.hexes]
        rows, columns = kernels.rows(self.slots, self.nodes, corners.start, corners.items)
        self.target = np.empty((mesh.n_hexes, kernels.PAIRS), np.int32)
        kernels.targets(self.slots, rows, columns, self.target)
        if part is None:
            parts = max((parts for least, parts in _PARTS if self.nodes.size >= least), default=1)
            part = max(-(-self.nodes.size // parts), 1)
        self._shares: dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}
        self.pattern = (part, rows, columns, *kernels.split(part, rows, columns))

    def shares(self, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The slots in `count` shares, and the hexes at the slots of each, as `assembly.assemble` takes them."""
        if count not in self._shares:
            bounds = np.linspace(0, self.nodes.size, count + 1).astype(np.int32)
            lowest = np.where(self.slots < 0, self.nodes.size, self.slots).min(axis=1)
            order = np.argsort(lowest, kind="stable").astype(np.int32)
            slots = self.slots[order]
            there = [order[((slots >= low) & (slots < high)).any(axis=1)] for low, high in itertools.pairwise(bounds)]
            start = np.cumsum([0, *map(len, there)], dtype=np.int32)
            self._shares[count] = bounds, start, np.concatenate(there)
        return self._shares[count]

    @property
    def blocks(self) -> int:
        """Blocks above the diagonal."""
        return self.pattern[2].size


def _near_each_other(mesh: Mesh) -> np.ndarray:
    """The free nodes in reverse Cuthill-McKee order, (k,) int32.

    It knows no coordinates: a mesh that is turned is smoothed as it was before.
    """
    rings, n = mesh.topology.rings, mesh.n_nodes
    graph = scipy.sparse.csr_matrix((np.ones(rings.items.size, np.int8), rings.items, rings.start), shape=(n, n))
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    return order[mesh.free[order]].astype(np.int32)
