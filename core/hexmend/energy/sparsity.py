"""Sparsity pattern of an assembled Hessian: pairs of free nodes that share a hex, and the order of nodes."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Callable
from functools import cached_property

import numpy as np

from hexmend.arrays import index_of
from hexmend.energy.ranks import ONE_RANK, Ranks
from hexmend.energy.workspace import Workspace
from hexmend.kernels import LANES, conjugate_gradients, ordering, release_free_memory
from hexmend.kernels import sparsity as kernels
from hexmend.kernels.assembly import HexShares
from hexmend.kernels.conjugate_gradients import BlockPattern, CoarsePattern
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.size_limits import MAX_ITEMS, overflow_as_mesh_error

#: Numbers of slots from which on they are divided into 2, 4 and 8 parts that threads solve in parallel.
_PARTS = ((4_000, 2), (100_000, 4), (400_000, 8))
#: Number of slots from which on a coarse space saves more than it costs.
_DEFLATED = 400_000
#: Number of free nodes, of all ranks, from which on packed blocks are worth what their rounding may cost.
_LARGE = 250_000


class BlockSparsity:
    """Sparsity pattern of the 3 x 3 blocks of a Hessian, with free nodes ordered in slots so that neighbours are close.

    It depends on the mesh alone, not on the number of threads.

    Parameters
    ----------
    mesh : Mesh
    parts : int, optional
        Number of parts of the slots; chosen by the number of free nodes by default.
    workspace : Workspace, optional
        For the solution of systems; by default one of its own.
    owned : (n,) bool, optional
        Nodes of this rank where a mesh is divided among several; the other free nodes are ghosts.
    ranks : Ranks, optional
        The ranks that share the matrix.

    Attributes
    ----------
    nodes : (k + ghosts,) int32
        Node in each slot; ghosts come last.
    ghosts : int
        Number of ghosts.
    bounds : (2 parts,) int32
        Limits of the parts, then of the separators, in slots.
    order : (k,) int32
        Slot of each free node of this rank, in the order of node numbers.
    has_opposite : bool
        Nodes that only opposite corners of hexes join have a block too; see `of_tetrahedra`.
    row_start, columns : (k + ghosts + 1,) int32, (blocks,) int32
        Blocks above the diagonal, as compressed rows; found on first use, with a `MeshError` for more than 32 bits can
        number.
    """

    def __init__(
        self,
        mesh: Mesh,
        parts: int | None = None,
        workspace: Workspace | None = None,
        owned: np.ndarray | None = None,
        ranks: Ranks = ONE_RANK,
    ):
        self.workspace, self.ranks = workspace or Workspace(), ranks
        rings = mesh.topology.rings
        free = mesh.free if owned is None else mesh.free & owned
        if parts is None:
            count = np.count_nonzero(free)
            parts = max((parts for least, parts in _PARTS if count >= least), default=1)
        self.nodes, self.bounds = ordering.slots(mesh.elements, rings.start, rings.items, free, parts)
        self.order, self.ghosts = np.argsort(self.nodes).astype(np.int32), 0
        if owned is not None:
            ghosts = np.flatnonzero(mesh.free & ~owned).astype(np.int32)
            self.nodes, self.ghosts = np.concatenate([self.nodes, ghosts]), ghosts.size
        self._slot_of_node = index_of(self.nodes, mesh.n_nodes)
        self._hexes, self._topology, self.has_opposite = mesh.elements, mesh.topology, True
        self._shares: tuple[int, HexShares | None] = 0, None
        if self.packs:  # a large mesh has no memory for what is needed once
            mesh.topology.release_rings()
        release_free_memory()  # before the blocks of the matrix take most of it

    @cached_property
    def of_tetrahedra(self) -> BlockSparsity:
        """The same slots, without blocks of nodes that only opposite corners of hexes join: a third fewer.

        Those blocks are 0 in the Hessian of a sum over corner tetrahedra, as the energy is for p = 1.
        """
        other = copy.copy(self)
        for name in ("_pattern", "of_tetrahedra"):
            other.__dict__.pop(name, None)
        other.has_opposite, other._shares = False, (0, None)
        return other

    @cached_property
    def _pattern(self) -> tuple[np.ndarray, np.ndarray]:
        corners = self._topology.node_corners
        with overflow_as_mesh_error("pairs of free nodes that share a hex"):
            pattern = kernels.pattern(
                self.slots, self.nodes, corners.start, corners.items, self.has_opposite, MAX_ITEMS
            )
        release_free_memory()
        return pattern

    @property
    def row_start(self) -> np.ndarray:
        """First block above the diagonal of each row, (k + ghosts + 1,) int32."""
        return self._pattern[0]

    @property
    def columns(self) -> np.ndarray:
        """Column of each block above the diagonal, (blocks,) int32.

        Raises
        ------
        MeshError
            For more blocks than 32 bits can number.
        """
        return self._pattern[1]

    @property
    def slots(self) -> np.ndarray:
        """Slot of each corner, -1 if it is fixed, (m, 8) int32."""
        return self._slot_of_node[self._hexes]

    def shares(self, count: int) -> HexShares:
        """Divide the slots into `count` shares and list the hexes at the slots of each; the last division is kept."""
        known, shares = self._shares
        if known != count:
            bounds = np.linspace(0, self.nodes.size, count + 1).astype(np.int32)
            slots = self.slots
            lowest, highest = slots.view(np.uint32).min(axis=1), slots.max(axis=1)  # -1, fixed, becomes the largest
            del slots
            order = np.argsort(lowest, kind="stable").astype(np.int32)
            lowest, highest = lowest[order], highest[order]
            there = [order[(lowest < high) & (highest >= low)] for low, high in itertools.pairwise(bounds)]
            start = np.cumsum([0, *map(len, there)], dtype=np.int32)
            chosen, at = np.concatenate(there), self._slot_of_node
            shares = HexShares(bounds, start, chosen, self._hexes, at, self.row_start, self.columns)
            self._shares = count, shares
        return shares

    @cached_property
    def packs(self) -> bool:
        """True if matrices need so much memory that their blocks are better packed.

        Processors without AVX unpack them too slowly.
        """
        return LANES > 2 and self.ranks.sum(self.order.size) >= _LARGE

    @property
    def first_separator(self) -> int:
        """The first slot of a separator or, where there are none, one more than the last."""
        return int(self.bounds[self.bounds.size // 2])

    @property
    def pattern(self) -> BlockPattern:
        """`bounds`, `row_start` and `columns` of the rows of this rank; a view, cheap to make."""
        row_start = self.row_start[: self.order.size + 1]
        return BlockPattern(self.bounds, row_start, self.columns[: row_start[-1]])

    @cached_property
    def coarse_space(self) -> CoarsePattern | None:
        """Aggregates by which a solution is deflated; None where the matrix is small or shared by ranks.

        Larger aggregates need more iterations, and more of them a longer factorisation of the coarse matrix: their
        number grows as the square root of that of the slots, and is about 900 for a million.
        """
        count = self.nodes.size
        if count < _DEFLATED or self.ranks.count > 1:
            return None
        self.workspace.release()
        pattern = CoarsePattern(*self.aggregates(round(1.5 * count ** (1 / 6))))
        self._topology.release_rings()
        return pattern

    def aggregates(self, distance: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Divide the slots into aggregates, whose translations are the columns of R.

        Parameters
        ----------
        distance : int
            Edges from a slot of an aggregate to its centre, at most; two centres are further from each other.

        Returns
        -------
        aggregate : (k,) int32
            Of each slot.
        row_start, columns : (k + 1,) int32, (blocks,) int32
            Aggregates that each row of A R meets, as compressed rows, A being a matrix of this pattern.
        """
        rings, corners = self._topology.rings, self._topology.node_corners
        graph = rings.start, rings.items, corners.start, corners.items
        return conjugate_gradients.coarse_pattern(self.slots, self._slot_of_node, self.nodes, *graph, distance)

    @cached_property
    def exchange(self) -> Callable[[np.ndarray], object]:
        """Function that writes the rows of ghosts of an array (k + ghosts, ...) with a row for each slot."""
        return self.ranks.exchange_of(self._slot_of_node)

    @property
    def blocks(self) -> int:
        """Number of blocks above the diagonal."""
        return self.columns.size
