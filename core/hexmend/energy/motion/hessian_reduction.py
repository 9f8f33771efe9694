"""Reduction of Hessians to the directions in which nodes move."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.motion.motion import Motion
from hexmend.energy.sparsity import BlockSparsity
from hexmend.energy.terms import UPPER
from hexmend.energy.workspace import Workspace
from hexmend.kernels import conjugate_gradients
from hexmend.mesh.mesh import Mesh


class HessianReduction:
    """Reduction of the Hessian H of all free nodes of a mesh to T^T H T; see `Motion`.

    What follows from a sparsity pattern is found once.

    Parameters
    ----------
    motion : Motion
    workspace : Workspace
        For the solution of systems.
    """

    def __init__(self, motion: Motion, workspace: Workspace):
        self._motion, self._workspace = motion, workspace
        self._known_blocks: dict[BlockSparsity, tuple[np.ndarray, ...]] = {}
        self._maps: dict[BlockSparsity, tuple[np.ndarray, ...]] = {}

    def reduced(self, full: AssembledHessian, x: np.ndarray) -> AssembledHessian:
        """Reduce a Hessian to T^T H T, with a multiple of the identity where nodes cannot move.

        Parameters
        ----------
        full : AssembledHessian
            Overwritten, and returned if no node is tied.
        x : (n, 3) float64
            Positions of the nodes.

        Returns
        -------
        AssembledHessian
        """
        motion, matrix = self._motion, full
        if motion.bent.size:
            turn = motion.turn(x).astype(full.dtype).reshape(-1, 9)
            slots, *blocks = self._blocks(full.sparsity)
            identity = np.eye(3, dtype=full.dtype).reshape(1, 9)
            conjugate_gradients.turn_blocks(np.concatenate([identity, turn]), *blocks, full.off_diagonal)
            if motion.row is not None:
                conjugate_gradients.turn_diagonal(turn, slots, full.diagonal)
        if motion.row is not None:
            matrix = self._merged(full, motion.row)
        if motion.bent.size:  # a scale between the extreme eigenvalues where they cannot move
            own = index_of(matrix.sparsity.nodes, motion.mesh.n_nodes)[motion.bent[motion.restricted]]
            conjugate_gradients.project_diagonal(turn[motion.restricted], own, matrix.diagonal)
        return matrix

    def _blocks(self, sparsity: BlockSparsity) -> tuple[np.ndarray, ...]:
        """Find the blocks above the diagonal that T changes.

        Returns
        -------
        slots : (b,) int32
            Of the nodes `bent`.
        at, row, column : (t,) int32
            Numbers of the blocks, with 1 + the index in `bent` of the node of each row and column; 0: in none.
        """
        if sparsity not in self._known_blocks:
            slots = index_of(sparsity.nodes, self._motion.mesh.n_nodes)[self._motion.bent]
            number = 1 + index_of(slots, sparsity.nodes.size)
            row, column = np.repeat(number, np.diff(sparsity.row_start)), number[sparsity.columns]
            at = np.flatnonzero(row | column).astype(np.int32)
            self._known_blocks[sparsity] = slots, at, row[at], column[at]
        return self._known_blocks[sparsity]

    @cached_property
    def ordered_nodes(self) -> BlockSparsity:
        """The order of free nodes in Hessians, with the pattern of all pairs that share a hex."""
        motion = self._motion
        return BlockSparsity(motion.mesh, workspace=self._workspace, owned=motion.owned, ranks=motion.ranks)

    @cached_property
    def _independent_nodes(self) -> BlockSparsity:
        """The order of independent nodes: hexes use the master of each tied node."""
        motion, mesh = self._motion, self._motion.mesh
        fixed = ~mask(motion.nodes, mesh.n_nodes)
        return BlockSparsity(Mesh(mesh.points, motion.root[mesh.elements]).with_fixed(fixed))

    def _merged(self, full: AssembledHessian, rows: np.ndarray) -> AssembledHessian:
        """Sum the blocks of tied nodes and of their masters; `rows` (k,) is `Motion.row`."""
        sparsity = self._independent_nodes if full.sparsity.has_opposite else self._independent_nodes.of_tetrahedra
        matrix = AssembledHessian.zero(sparsity, full.dtype)
        matrix.exponent = full.exponent
        order, start, transposed, inside, inside_slot, slot_of = self._merge_map(full.sparsity, sparsity, rows)
        blocks = full.off_diagonal[:-1].reshape(-1, 3, 3)
        blocks[transposed] = blocks[transposed].transpose(0, 2, 1).copy()
        if order.size:
            matrix.off_diagonal[:-1] = np.add.reduceat(blocks.reshape(-1, 9)[order], start, axis=0)
        np.add.at(matrix.diagonal, slot_of, full.diagonal)
        own = blocks[inside] + blocks[inside].transpose(0, 2, 1)
        np.add.at(matrix.diagonal, inside_slot, own.reshape(-1, 9)[:, UPPER])
        return matrix

    def _merge_map(self, whole: BlockSparsity, part: BlockSparsity, rows: np.ndarray) -> tuple[np.ndarray, ...]:
        """Map of the blocks of all free nodes to those of independent ones; it depends on the patterns alone."""
        if whole not in self._maps:
            slot_of = np.empty(whole.nodes.size, np.int64)
            slot_of[whole.order] = part.order[rows]
            row = slot_of[np.repeat(np.arange(whole.nodes.size), np.diff(whole.row_start))]
            column, count = slot_of[whole.columns], part.nodes.size
            key = np.minimum(row, column) * count + np.maximum(row, column)
            inside = np.flatnonzero(row == column)
            order = np.argsort(key, kind="stable")
            order = order[row[order] != column[order]]
            start = np.flatnonzero(np.diff(key[order], prepend=-1))  # the blocks of `part` are in this order
            self._maps[whole] = order, start, np.flatnonzero(row > column), inside, row[inside], slot_of
        return self._maps[whole]
