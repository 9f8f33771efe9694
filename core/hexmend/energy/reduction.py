"""Reduction of the free nodes of a mesh to those that move independently of each other."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import index_of
from hexmend.energy.assembled_hessian import AssembledHessian, unpack_symmetric
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import conjugate_gradients
from hexmend.mesh.mesh import Mesh

#: Places of xx xy xz yy yz zz in a matrix of 3 rows.
_UPPER = [0, 1, 2, 4, 5, 8]


class Reduction:
    """Linear map T from displacements of the independent free nodes of a mesh to those of all its free nodes.

    Tied nodes move as their masters do, restricted nodes in their planes and lines.

    Parameters
    ----------
    mesh : Mesh
        With a linear motion.

    Attributes
    ----------
    nodes : (j,) int32
        Independent nodes: free ones that are not tied, ascending.
    row : (k,) int32
        Index in `nodes` of each free node, or of its master.
    """

    def __init__(self, mesh: Mesh):
        motion, n = mesh.linear_motion, mesh.n_nodes
        free = np.flatnonzero(mesh.free)
        root, turn = motion.roots(n), np.tile(np.eye(3), (n, 1, 1))
        turn[motion.nodes] = motion.projectors
        turn[motion.tied] = motion.rotations @ turn[motion.master]
        self.mesh, self.root = mesh, root
        self.nodes = free[root[free] == free].astype(np.int32)
        self.row = index_of(self.nodes, n)[root[free]]
        self._own, self._tied = np.flatnonzero(root[free] == free), np.flatnonzero(root[free] != free)
        self._turn = turn[free]
        self._bent = np.flatnonzero((self._turn != np.eye(3)).any(axis=(1, 2)))
        self._scales = np.einsum("kii->ki", self._turn).copy()  # all of T in planes and lines of the axes
        self._skew = self._bent[(self._turn != self._scales[:, :, None] * np.eye(3)).any(axis=(1, 2))[self._bent]]
        self._turned: dict[tuple[BlockSparsity, np.dtype], tuple] = {}
        self._others: dict[np.dtype, tuple[np.ndarray, np.ndarray]] = {}
        self._maps: dict[BlockSparsity, tuple[np.ndarray, ...]] = {}
        own_turn = turn[self.nodes]
        self._restricted = np.flatnonzero((own_turn != np.eye(3)).any(axis=(1, 2)))
        self._projectors = own_turn[self._restricted]

    @property
    def has_ties(self) -> bool:
        """True if any free node is tied."""
        return self._tied.size > 0

    def expand(self, steps: np.ndarray) -> np.ndarray:
        """T times steps of the independent nodes, (j, 3): those of all free nodes, (k, 3)."""
        steps = steps.take(self.row, axis=0)
        turned = np.einsum("kij,kj->ki", self._turn[self._skew], steps[self._skew])
        steps *= self._scales
        steps[self._skew] = turned
        return steps

    def contract(self, forces: np.ndarray) -> np.ndarray:
        """T^T times vectors of all free nodes, (k, 3): those of the independent nodes, (j, 3)."""
        turned = np.einsum("kji,kj->ki", self._turn[self._skew], forces[self._skew])
        forces = forces * self._scales
        forces[self._skew] = turned
        sums = forces[self._own]
        np.add.at(sums, self.row[self._tied], forces[self._tied])
        return sums

    def inadmissible(self, vectors: np.ndarray) -> np.ndarray:
        """Components of vectors of the independent nodes, (j, 3), that their planes and lines do not admit."""
        outside = np.zeros(vectors.shape)
        rows = self._restricted
        outside[rows] = vectors[rows] - np.einsum("kij,kj->ki", self._projectors, vectors[rows])
        return outside

    @cached_property
    def independent_mesh(self) -> Mesh:
        """Mesh in which hexes use the master of each tied node, and only independent nodes are free."""
        mesh = self.mesh
        if not self.has_ties:
            return mesh
        fixed = np.ones(mesh.n_nodes, dtype=bool)
        fixed[self.nodes] = False
        return Mesh(mesh.points, self.root[mesh.hexes]).with_fixed(fixed)

    def reduced(self, full: AssembledHessian) -> AssembledHessian:
        """Reduce a Hessian of all free nodes to T^T H T, with a multiple of the identity where nodes cannot move.

        Parameters
        ----------
        full : AssembledHessian
            Overwritten, and returned if no node is tied.

        Returns
        -------
        AssembledHessian
        """
        dtype = full.dtype
        turn, (scaled, scale), (turned, row, column), slots = self._turned_blocks(full)
        full.off_diagonal[scaled] = full.off_diagonal.take(scaled, axis=0, mode="clip") * scale  # faster than *=
        conjugate_gradients.turn_blocks(turn.reshape(-1, 9), turned, row, column, full.off_diagonal)
        own = turn[slots].transpose(0, 2, 1) @ unpack_symmetric(full.diagonal[slots]) @ turn[slots]
        full.diagonal[slots] = own.reshape(-1, 9)[:, _UPPER]
        matrix = self._merged(full) if self.has_ties else full
        slots, (dimensions, others) = matrix.order[self._restricted], self._inadmissible_blocks(dtype)
        diagonal = matrix.diagonal.take(slots, axis=0)
        size = np.abs(diagonal[:, [0, 3, 5]].sum(axis=1) / dimensions)
        size = np.where(size > 0, size, 1)  # a scale between the extreme eigenvalues
        matrix.diagonal[slots] = diagonal + size[:, None] * others
        return matrix

    def _inadmissible_blocks(self, dtype: np.dtype) -> tuple[np.ndarray, np.ndarray]:
        """Number of directions of each restricted node, at least 1, (r,), and projectors to the others, (r, 6)."""
        if dtype not in self._others:
            admitted = self._projectors.astype(dtype)
            others = (np.eye(3, dtype=dtype) - admitted).reshape(-1, 9)[:, _UPPER]
            self._others[dtype] = np.maximum(np.trace(admitted, axis1=1, axis2=2), 1), others
        return self._others[dtype]

    def _turned_blocks(self, full: AssembledHessian) -> tuple:
        """T of each slot, and the blocks above the diagonal and the slots that it changes; it depends on the pattern.

        Blocks of nodes in planes and lines of the axes are only scaled: their numbers and factors, (b,) and (b, 9),
        first. Then there are the numbers of the others with the slots of their rows and columns.
        """
        dtype, sparsity = full.dtype, full.sparsity
        if (sparsity, dtype) not in self._turned:
            turn = np.empty(self._turn.shape, dtype)
            turn[full.order] = self._turn
            row = np.repeat(np.arange(sparsity.nodes.size), np.diff(sparsity.row_start))
            column, diagonal = sparsity.columns, np.einsum("kii->ki", turn)
            bent = (turn != np.eye(3)).any(axis=(1, 2))
            skew = bent & (turn != diagonal[:, :, None] * np.eye(3)).any(axis=(1, 2))
            turned = skew[row] | skew[column]
            scaled = np.flatnonzero((bent[row] | bent[column]) & ~turned)
            turned = np.flatnonzero(turned)
            scale = (diagonal[row[scaled], :, None] * diagonal[column[scaled], None]).reshape(-1, 9)
            others = turned.astype(np.int32), row[turned].astype(np.int32), column[turned]
            self._turned[sparsity, dtype] = turn, (scaled, scale), others, np.flatnonzero(bent)
        return self._turned[sparsity, dtype]

    @cached_property
    def _ordered_nodes(self) -> BlockSparsity:
        return BlockSparsity(self.independent_mesh)

    def sparsity(self, whole: BlockSparsity) -> BlockSparsity:
        """Sparsity pattern of the reduced Hessian, from that of the Hessian of all free nodes."""
        return self._ordered_nodes if whole.has_opposite else self._ordered_nodes.of_tetrahedra

    def _merged(self, full: AssembledHessian) -> AssembledHessian:
        """Sum the blocks of tied nodes and of their masters."""
        matrix = AssembledHessian.zero(self.sparsity(full.sparsity), full.dtype)
        matrix.exponent = full.exponent
        order, start, transposed, inside, inside_slot, slot_of = self._merge_map(full)
        blocks = full.off_diagonal[:-1].reshape(-1, 3, 3)
        blocks[transposed] = blocks[transposed].transpose(0, 2, 1).copy()
        if order.size:
            matrix.off_diagonal[:-1] = np.add.reduceat(blocks.reshape(-1, 9)[order], start, axis=0)
        np.add.at(matrix.diagonal, slot_of, full.diagonal)
        own = blocks[inside] + blocks[inside].transpose(0, 2, 1)
        np.add.at(matrix.diagonal, inside_slot, own.reshape(-1, 9)[:, _UPPER])
        return matrix

    def _merge_map(self, full: AssembledHessian) -> tuple[np.ndarray, ...]:
        """Map of the blocks of all free nodes to those of `sparsity`; it depends on the patterns alone."""
        whole = full.sparsity
        if whole not in self._maps:
            part = self.sparsity(whole)
            slot_of = np.empty(whole.nodes.size, np.int64)
            slot_of[whole.order] = part.order[self.row]
            row = slot_of[np.repeat(np.arange(whole.nodes.size), np.diff(whole.row_start))]
            column, count = slot_of[whole.columns], part.nodes.size
            key = np.minimum(row, column) * count + np.maximum(row, column)
            inside = np.flatnonzero(row == column)
            order = np.argsort(key, kind="stable")
            order = order[row[order] != column[order]]
            start = np.flatnonzero(np.diff(key[order], prepend=-1))  # the blocks of `part` are in this order
            self._maps[whole] = order, start, np.flatnonzero(row > column), inside, row[inside], slot_of
        return self._maps[whole]
