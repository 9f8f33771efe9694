"""Reduction of Hessians to the directions in which nodes move."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.energy.assembled_hessian import AssembledHessian, unpack_symmetric
from hexmend.energy.motion.motion import Motion
from hexmend.energy.sparsity import BlockSparsity
from hexmend.energy.terms import UPPER
from hexmend.energy.workspace import Workspace
from hexmend.kernels import conjugate_gradients
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array


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
        self._maps: dict[tuple[BlockSparsity, BlockSparsity], list[csr_array]] = {}

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
        motion = self._motion
        if motion.hanging[0].size:
            full = self._merged(full, self._without_hanging, self._anchors)
        matrix = full
        if motion.bent.size:
            turn = motion.turn(x).astype(full.dtype).reshape(-1, 9)
            slots, *blocks = self._blocks(full.sparsity)
            identity = np.eye(3, dtype=full.dtype).reshape(1, 9)
            conjugate_gradients.turn_blocks(np.concatenate([identity, turn]), *blocks, full.off_diagonal)
            if motion.row is not None:
                conjugate_gradients.turn_diagonal(turn, slots, full.diagonal)
        if motion.row is not None and motion.tied.size:
            nodes = self._independent_nodes
            matrix = self._merged(full, nodes if full.sparsity.has_opposite else nodes.of_tetrahedra, self._masters)
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
    def _without_hanging(self) -> BlockSparsity:
        """The order of free nodes that do not hang: hexes use those on which a hanging node hangs."""
        linear, mesh = self._motion.mesh.linear_motion, self._motion.mesh
        assert linear is not None  # else no node hangs
        rows = LinearMotion(hanging=linear.hanging, anchors=linear.anchors, weights=linear.weights)
        leads = mesh.free & rows.leads(mesh.n_nodes)
        return BlockSparsity(Mesh.of_cells(mesh.points, rows.independent_rows(mesh.elements, mesh.n_nodes), ~leads))

    @cached_property
    def _independent_nodes(self) -> BlockSparsity:
        """The order of independent nodes: hexes use the master of each tied node."""
        motion, mesh, linear = self._motion, self._motion.mesh, self._motion.mesh.linear_motion
        assert linear is not None  # else no node is tied
        fixed = ~mask(motion.nodes, mesh.n_nodes)
        return BlockSparsity(Mesh.of_cells(mesh.points, linear.independent_rows(mesh.elements, mesh.n_nodes), fixed))

    @property
    def _masters(self) -> tuple[np.ndarray, ...]:
        """Free nodes that do not hang, by index, the independent node that each follows, and the weight 1."""
        motion = self._motion
        rows = np.delete(motion.row, motion.hanging[0])
        return np.arange(rows.size), rows, np.ones(rows.size)

    @property
    def _anchors(self) -> tuple[np.ndarray, ...]:
        """Free nodes and those among the ones that do not hang on which each hangs, by index, and their weights."""
        hanging, anchors, weights = self._motion.hanging
        others = np.delete(np.arange(self._motion.free.size), hanging)
        number = index_of(others, self._motion.free.size)
        ends = np.concatenate([others, hanging]), np.concatenate([number[others], number[anchors]])
        return *ends, np.concatenate([np.ones(others.size), weights])

    def _merged(
        self, full: AssembledHessian, sparsity: BlockSparsity, entries: tuple[np.ndarray, ...]
    ) -> AssembledHessian:
        """Sum blocks times weights to those of other nodes: W^T H W.

        Parameters
        ----------
        full : AssembledHessian
        sparsity : BlockSparsity
            Of the sum.
        entries : tuple of (e,) int, (e,) int, (e,) float64
            Of W: the index of a node of `full`, that of a node of the sum, both by number, and the weight.
        """
        matrix = AssembledHessian.zero(sparsity, full.dtype)
        matrix.exponent = full.exponent
        sums = self._sums_of_blocks(full.sparsity, sparsity, *entries)
        upper, lower, own = (each.astype(full.dtype, copy=False) for each in sums)
        blocks = np.concatenate([full.off_diagonal[:-1].reshape(-1, 3, 3), unpack_symmetric(full.diagonal)])
        blocks, turned = blocks.reshape(-1, 9), blocks.transpose(0, 2, 1).reshape(-1, 9)
        matrix.off_diagonal[:-1] = upper @ blocks + lower @ turned
        matrix.diagonal[:] = (own @ (blocks + turned))[:, UPPER]
        return matrix

    def _sums_of_blocks(
        self, whole: BlockSparsity, part: BlockSparsity, source: np.ndarray, target: np.ndarray, weight: np.ndarray
    ) -> list[csr_array]:
        """Find the matrices by which blocks of `whole` are summed to those of `part`; the patterns alone decide them.

        Returns
        -------
        list of csr_array
            From the blocks above the diagonal and then those on it: to those above the diagonal, the same from the
            transposed blocks, and to those on the diagonal from each block plus its transpose.
        """
        if (whole, part) in self._maps:
            return self._maps[whole, part]
        from scipy.sparse import csr_array

        slots, rows = whole.order[source], np.arange(whole.nodes.size)
        order = np.argsort(slots, kind="stable")
        to, weight = part.order[target[order]].astype(np.int64), weight[order]
        entries = np.bincount(slots, minlength=rows.size)
        first = np.cumsum(entries) - entries
        row, column = np.append(np.repeat(rows, np.diff(whole.row_start)), rows), np.append(whole.columns, rows)
        several = entries[row] * entries[column]
        block = np.repeat(np.arange(row.size), several)
        pair = np.arange(block.size) - np.repeat(np.cumsum(several) - several, several)
        one = first[row[block]] + pair // entries[column[block]]
        other = first[column[block]] + pair % entries[column[block]]
        used = (block < whole.blocks) | (one <= other)
        block, one, other = block[used], one[used], other[used]
        weights = weight[one] * weight[other] * np.where(one == other, 0.5, 1.0)
        ends, count = np.sort(np.stack([to[one], to[other]]), axis=0), part.nodes.size
        known = np.repeat(np.arange(count), np.diff(part.row_start)) * count + part.columns
        place = np.searchsorted(known, ends[0] * count + ends[1])
        cases = (
            (to[one] < to[other], place, part.blocks),
            (to[one] > to[other], place, part.blocks),
            (to[one] == to[other], ends[0], count),
        )
        self._maps[whole, part] = sums = [
            csr_array((weights[of], (at[of], block[of])), shape=(height, row.size)) for of, at, height in cases
        ]
        return sums
