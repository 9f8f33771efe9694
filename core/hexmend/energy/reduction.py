"""Reduction of the free nodes of a mesh to those that move independently of each other."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.energy.assembled_hessian import AssembledHessian
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
        self.mesh, self.root = mesh, motion.roots(n)
        own = self.root[free] == free
        self.nodes = free[own].astype(np.int32)
        self.row = index_of(self.nodes, n)[self.root[free]]
        self._own, self._tied = np.flatnonzero(own), np.flatnonzero(~own)
        self._bent, self._turn = _turned_nodes(mesh, free)
        self._scales = np.einsum("bii->bi", self._turn).copy()  # all of T in planes and lines of the axes
        self._skew = np.flatnonzero((self._turn != self._scales[:, :, None] * np.eye(3)).any(axis=(1, 2)))
        self._bent_rows, self._skew_rows = self._bent.astype(np.int32), self._bent[self._skew]
        self._turn_of_skew = self._turn[self._skew]
        self._turned: dict[tuple[BlockSparsity, np.dtype], tuple] = {}
        self._others: dict[np.dtype, tuple[np.ndarray, np.ndarray]] = {}
        self._maps: dict[BlockSparsity, tuple[np.ndarray, ...]] = {}
        restricted = np.flatnonzero(own[self._bent])
        self._restricted = self.row[self._bent[restricted]]  # in `nodes`
        self._projectors = self._turn[restricted]

    @property
    def has_ties(self) -> bool:
        """True if any free node is tied."""
        return self._tied.size > 0

    def expand(self, steps: np.ndarray) -> np.ndarray:
        """T times steps of the independent nodes, (j, 3): those of all free nodes, (k, 3)."""
        steps = steps.take(self.row, axis=0)
        turned = np.einsum("kij,kj->ki", self._turn_of_skew, steps.take(self._skew_rows, axis=0))
        steps[self._bent_rows] *= self._scales
        steps[self._skew_rows] = turned
        return steps

    def contract(self, forces: np.ndarray) -> np.ndarray:
        """Reduce vectors of all free nodes, (k, 3), overwritten, to the independent nodes, (j, 3), by T^T."""
        turned = np.einsum("kji,kj->ki", self._turn_of_skew, forces.take(self._skew_rows, axis=0))
        forces[self._bent_rows] *= self._scales
        forces[self._skew_rows] = turned
        if not self.has_ties:
            return forces
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
        (scaled, scale), (turn, turned, row, column), slots = self._turned_blocks(full)
        conjugate_gradients.scale_blocks(scaled, scale, full.off_diagonal)
        if turned.size:
            conjugate_gradients.turn_blocks(turn.reshape(-1, 9), turned, row, column, full.off_diagonal)
        conjugate_gradients.turn_diagonal(self._turn.astype(dtype).reshape(-1, 9), slots, full.diagonal)
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
        """The blocks above the diagonal that T changes, and the slots of `_bent`; they depend on the pattern.

        Blocks of nodes in planes and lines of the axes are only scaled: their numbers and factors, (b,) and (b, 9),
        first. Then there is T of each slot, with the numbers of the others and the slots of their rows and columns.
        """
        dtype, sparsity = full.dtype, full.sparsity
        if (sparsity, dtype) not in self._turned:
            count, slots = sparsity.nodes.size, full.order[self._bent]
            diagonal, bent, skew = np.ones((count, 3), dtype), mask(slots, count), mask(slots[self._skew], count)
            diagonal[slots] = self._scales
            row = np.repeat(np.arange(count, dtype=np.int32), np.diff(sparsity.row_start))
            column = sparsity.columns
            turned = skew[row] | skew[column]
            scaled = np.flatnonzero((bent[row] | bent[column]) & ~turned).astype(np.int32)
            turned = np.flatnonzero(turned)
            scale = (diagonal[row[scaled], :, None] * diagonal[column[scaled], None]).reshape(-1, 9)
            turn = np.empty((0, 3, 3), dtype)
            if turned.size:
                turn = np.tile(np.eye(3, dtype=dtype), (count, 1, 1))
                turn[slots] = self._turn
            others = turn, turned.astype(np.int32), row[turned], column[turned]
            self._turned[sparsity, dtype] = (scaled, scale), others, slots
        return self._turned[sparsity, dtype]

    @cached_property
    def _ordered_nodes(self) -> BlockSparsity:
        return BlockSparsity(self.independent_mesh)

    def sparsity(self, whole: BlockSparsity) -> BlockSparsity:
        """Return the sparsity pattern of the reduced Hessian, given the pattern for all free nodes."""
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


def _turned_nodes(mesh: Mesh, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows (b,) of the free nodes (k,) where T is not the identity, ascending, and its blocks there, (b, 3, 3)."""
    motion = mesh.linear_motion
    number = index_of(free, mesh.n_nodes)
    place = index_of(motion.nodes, mesh.n_nodes)[motion.master]
    of_master = np.tile(np.eye(3), (place.size, 1, 1))
    of_master[place >= 0] = motion.projectors[place[place >= 0]]
    rows = number[np.concatenate([motion.nodes, motion.tied])]
    turn = np.concatenate([motion.projectors, motion.rotations @ of_master])
    used = np.flatnonzero((rows >= 0) & (turn != np.eye(3)).any(axis=(1, 2)))
    used = used[np.argsort(rows[used])]
    return rows[used].astype(np.int64), turn[used]
