"""Assembled Hessian, and its solution by preconditioned conjugate gradients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend.energy.linear_operator import SymmetricOperator
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import conjugate_gradients as kernels

if TYPE_CHECKING:
    from scipy.sparse import csr_array

#: A matrix whose largest entry is smaller than this loses digits of its other entries in single precision.
_SINGLE_UNDERFLOW = 1e-25
#: Exponents of two up to this size are no more than a factor that float64 has.
_MAX_EXPONENT = 900


@dataclass(frozen=True, eq=False)
class CGResult:
    """Result of conjugate gradients.

    Parameters
    ----------
    x : (3 k,) float64
        Solution.
    iterations : int
    negative_curvature : bool
        True if they stopped at a direction of negative curvature: the matrix is not positive definite.
    """

    x: np.ndarray
    iterations: int
    negative_curvature: bool


class AssembledHessian(SymmetricOperator):
    """Symmetric matrix of 3 x 3 blocks, (3 k, 3 k).

    Vectors are in the order of the free nodes by number, as for `Hessian`.

    Parameters
    ----------
    sparsity : BlockSparsity
    off_diagonal : (blocks + 1, 9) float32 or float64, or (blocks + 1, 12) int16
        Blocks above the diagonal, by rows; the last row is unused (see `hexmend.kernels.conjugate_gradients`). int16:
        packed (see `hexmend.kernels.assembly.assemble_packed`).
    diagonal : (k, 6) float32 or float64
        Diagonal block of each slot, in the precision of the matrix: xx xy xz yy yz zz.
    exponent : int
        Scale: the matrix is 2^exponent times the blocks.
    """

    def __init__(self, sparsity: BlockSparsity, off_diagonal: np.ndarray, diagonal: np.ndarray, exponent: int = 0):
        super().__init__(3 * sparsity.order.size)
        self.sparsity, self.off_diagonal, self.diagonal, self.exponent = sparsity, off_diagonal, diagonal, exponent
        self.order = sparsity.order

    def reset(self) -> AssembledHessian:
        """Zero the storage for reuse; the old matrix becomes invalid."""
        if not self.packed:  # those are written, not added to
            self.off_diagonal.fill(0)
        elif not len(self.off_diagonal):
            self.off_diagonal = _packed_blocks(self.sparsity)
        self.diagonal.fill(0)
        self.exponent = 0
        return self

    def lend_memory(self) -> None:
        """Let the workspace use the memory of packed blocks until `reset`; the matrix becomes invalid."""
        if self.packed and len(self.off_diagonal):
            self.sparsity.workspace.give(self.off_diagonal)
            self.off_diagonal = self.off_diagonal[:0].copy()

    @property
    def has_lent_memory(self) -> bool:
        """True after `lend_memory` has made the matrix invalid."""
        return self.packed and not len(self.off_diagonal)

    @classmethod
    def zero(cls, sparsity: BlockSparsity, dtype: type, packed: bool = False) -> AssembledHessian:
        """Make a zero matrix of a sparsity pattern; `packed`: with blocks of 24 bytes for single precision."""
        off_diagonal = _packed_blocks(sparsity) if packed else np.zeros((sparsity.blocks + 1, 9), dtype)
        if packed:
            off_diagonal.fill(0)
        return cls(sparsity, off_diagonal, np.zeros((sparsity.nodes.size, 6), dtype))

    @property
    def dtype(self) -> np.dtype:
        """Precision of the matrix: that of the diagonal blocks, and of vectors that it is solved for."""
        return self.diagonal.dtype

    @property
    def packed(self) -> bool:
        """True if the blocks above the diagonal have 24 bytes."""
        return self.off_diagonal.dtype == np.int16

    def underflows(self) -> bool:
        """Return True if the blocks are so small that single precision loses digits of them."""
        return self._largest(self.diagonal) < _SINGLE_UNDERFLOW

    def _largest(self, numbers: np.ndarray) -> float:
        """Return the largest absolute value of some numbers of each rank."""
        return self.sparsity.ranks.greatest(float(np.abs(numbers).max(initial=0.0)))

    def normalised(self, dtype: type) -> AssembledHessian:
        """Return the matrix in another precision, scaled so that its largest diagonal entry lies in [1/2, 1)."""
        exponent = int(np.frexp(self._largest(self.diagonal))[1])
        off_diagonal, diagonal = (
            np.ldexp(blocks, -exponent).astype(dtype) for blocks in (self.unpacked_blocks(), self.diagonal)
        )
        return AssembledHessian(self.sparsity, off_diagonal, diagonal, self.exponent + exponent)

    def _product(self, v: np.ndarray) -> np.ndarray:
        if self.sparsity.ghosts:
            raise ValueError("the product of a matrix that ranks share with a vector is not implemented")
        x = v.reshape(-1, 3)
        y = np.empty_like(x)
        kernels.product(self.sparsity.pattern, self.off_diagonal, self.diagonal, self.order, x, y)
        return np.ldexp(y.ravel(), self.exponent) if self.exponent else y.ravel()

    def _to_slots(self, v: np.ndarray, exponent: int) -> np.ndarray:
        """Rearrange v (3 k,) times 2^exponent by slots, (k, 4), in the matrix's precision; the fourth column is 0."""
        x = np.empty((self.order.size, 4), self.dtype)
        if abs(exponent) > _MAX_EXPONENT:
            v, exponent = np.ldexp(v, exponent), 0
        kernels.to_slots(v.reshape(-1, 3), self.order, 2.0**exponent, x)
        return x

    def _from_slots(self, x: np.ndarray, exponent: int) -> np.ndarray:
        """Rearrange x (k, 4) times 2^exponent by free nodes, (3 k,) float64; infinite where it overflows."""
        v, large = np.empty((self.order.size, 3)), abs(exponent) > _MAX_EXPONENT
        kernels.from_slots(x, self.order, 1.0 if large else 2.0**exponent, v)
        with np.errstate(over="ignore"):
            return np.ldexp(v.ravel(), exponent) if large else v.ravel()

    def solve(
        self, right: np.ndarray, tolerance: float, iterations: int, damping: float = 0.0, deflated: bool = False
    ) -> CGResult:
        """Solve by conjugate gradients, preconditioned by symmetric Gauss-Seidel.

        At a direction of negative curvature the iterate before it is returned, or, in the first iteration, that
        direction itself: both are descent directions for right = -gradient. The result is 0 for a right-hand side that
        is not finite. Components that overflow float64 are infinite.

        The right-hand side is scaled by a power of two so that its largest component lies in [1/2, 1): in single
        precision squares of very small or large numbers would vanish or overflow.

        Parameters
        ----------
        right : (3 k,) float64
        tolerance : float
            Bound of the residual relative to the right-hand side, both in the norm of the preconditioner.
        iterations : int
            Largest number of iterations.
        damping : float
            Multiple of the diagonal blocks, made positive definite, that is added to the matrix.
        deflated : bool
            Solve for the translations of aggregates of nodes exactly (`BlockSparsity.coarse_space`): fewer iterations
            where the solution has long waves, and each costs a tenth more.

        Returns
        -------
        CGResult

        Raises
        ------
        MeshError
            For a right-hand side of another shape or type.
        """
        right = self._vector(right, "the right-hand side")
        size = self._largest(right)
        if size == 0 or not np.isfinite(size):
            return CGResult(np.zeros(right.size), 0, False)
        exponent = int(np.frexp(size)[1])
        x = self._to_slots(right, -exponent)  # scaling by a power of two is exact
        sparsity = self.sparsity
        coupled = sparsity.ranks.count > 1
        pattern = sparsity.pattern
        size = kernels.workspace_size(pattern, sparsity.ghosts, coupled)
        coarse = sparsity.coarse_space if deflated else None
        if coarse is not None:
            size += kernels.coarse_workspace_size(coarse)
        coupling = (sparsity.ghosts, sparsity.ranks.sum, sparsity.exchange) if coupled else ()
        work = sparsity.workspace.array((size,), x.dtype.type)
        blocks = self.off_diagonal, self.diagonal
        count, end = kernels.solve(
            pattern, *blocks, damping, x, tolerance, iterations, x, work, *coupling, coarse=coarse
        )
        del work
        if self.packed:  # the line search of a large mesh needs the memory
            sparsity.workspace.release()
        solution = self._from_slots(x, exponent - self.exponent)
        return CGResult(solution, count, end is kernels.SolveStatus.NEGATIVE_CURVATURE)

    def unpacked_blocks(self) -> np.ndarray:
        """Return the blocks above the diagonal in the precision of the matrix, (blocks + 1, 9)."""
        if not self.packed:
            return self.off_diagonal
        upper, last = self.off_diagonal[:, :9].astype(np.int32) << 4, self.off_diagonal[:, 9].astype(np.int32)
        lower = self.off_diagonal[:, 10:].copy().view(np.uint32) >> np.arange(0, 32, 4, dtype=np.uint32) & 15
        upper[:, :8] |= lower.astype(np.int32)
        upper[:, 8] |= last >> 8 & 15
        return ((last & 255) << 23).view(np.float32)[:, None] * upper.astype(np.float32)

    @property
    def diagonal_blocks(self) -> np.ndarray:
        """Diagonal blocks in the order of the free nodes, (k, 6) float64: xx xy xz yy yz zz."""
        return np.ldexp(self.diagonal[self.order].astype(np.float64), self.exponent)

    def matrix(self) -> csr_array:
        """Convert to a sparse matrix of SciPy, (3 k, 3 k), with about 243 entries for each free node."""
        from scipy.sparse import coo_array

        start, columns = self.sparsity.row_start, self.sparsity.columns
        slots = np.arange(self.order.size)
        rows, off_diagonal = np.repeat(slots, np.diff(start)), self.unpacked_blocks()[:-1].reshape(-1, 3, 3)
        i, j = np.concatenate([slots, rows, columns]), np.concatenate([slots, columns, rows])
        blocks = np.concatenate([unpack_symmetric(self.diagonal), off_diagonal, off_diagonal.transpose(0, 2, 1)])
        free = np.argsort(self.order)  # the number of each slot's node among the free nodes
        row = 3 * free[i][:, None, None] + np.arange(3)[:, None]
        column = 3 * free[j][:, None, None] + np.arange(3)
        row, column = np.broadcast_arrays(row, column)
        blocks = np.ldexp(blocks.astype(np.float64), self.exponent)
        return coo_array((blocks.ravel(), (row.ravel(), column.ravel())), shape=self.shape).tocsr()


def _packed_blocks(sparsity: BlockSparsity) -> np.ndarray:
    """Take memory for packed blocks from the workspace; all but the unused one may have any values."""
    blocks = sparsity.workspace.take((sparsity.blocks + 1, 12), np.int16)
    blocks[-1] = 0
    return blocks


def unpack_symmetric(blocks: np.ndarray) -> np.ndarray:
    """Expand symmetric blocks (k, 6) to matrices (k, 3, 3)."""
    return blocks[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)
