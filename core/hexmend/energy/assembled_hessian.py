"""An assembled Hessian."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend.energy.linear_operator import SymmetricOperator
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import conjugate_gradients as kernels

if TYPE_CHECKING:
    from scipy.sparse import csr_array

#: Where the largest number of a matrix is smaller than this, single precision has no digits for the others.
_SINGLE_UNDERFLOW = 1e-25


@dataclass(frozen=True, eq=False)
class CGResult:
    """What conjugate gradients reached.

    Parameters
    ----------
    x : (3 k,) float64
    iterations : int
    negative_curvature : bool
        Whether they stopped because the matrix is not positive definite.
    """

    x: np.ndarray
    iterations: int
    negative_curvature: bool


class AssembledHessian(SymmetricOperator):
    """A symmetric matrix of 3 x 3 blocks, (3 k, 3 k), and a system to be solved.

    Vectors are in the order of the free nodes by number, as those of `Hessian` are.

    Parameters
    ----------
    couplings : BlockSparsity
    off : (blocks + 1, 9) float32 or float64
        Blocks above the diagonal, by rows; the last is no block (see `conjugate_gradients`).
    diagonal : (k, 6) of the same
        xx xy xz yy yz zz of each slot.
    exponent : int
        The matrix is 2^exponent times what the blocks hold.
    """

    def __init__(self, couplings: BlockSparsity, off: np.ndarray, diagonal: np.ndarray, exponent: int = 0):
        super().__init__(3 * couplings.nodes.size)
        self.couplings, self.off, self.diagonal, self.exponent = couplings, off, diagonal, exponent
        self.order = couplings.order
        self._work = np.empty(64 * couplings.nodes.size + 16, off.dtype)

    def reset(self) -> AssembledHessian:
        """The same room for another matrix, all zero; this one is gone."""
        self.off.fill(0)
        self.diagonal.fill(0)
        self.exponent = 0
        return self

    @classmethod
    def zero(cls, couplings: BlockSparsity, dtype: type) -> AssembledHessian:
        """A matrix of that pattern, all zero."""
        off = np.zeros((couplings.blocks + 1, 9), dtype)
        return cls(couplings, off, np.zeros((couplings.nodes.size, 6), dtype))

    def underflows(self) -> bool:
        """Whether the blocks are so small that single precision rounds them or loses them."""
        return float(np.abs(self.diagonal).max(initial=0.0)) < _SINGLE_UNDERFLOW

    def normalised(self, dtype: type) -> AssembledHessian:
        """The same matrix with blocks of another precision, the largest number on the diagonal between 1/2 and 1."""
        exponent = int(np.frexp(np.abs(self.diagonal).max(initial=0.0))[1])
        off, diagonal = (np.ldexp(blocks, -exponent).astype(dtype) for blocks in (self.off, self.diagonal))
        return AssembledHessian(self.couplings, off, diagonal, self.exponent + exponent)

    def _product(self, v: np.ndarray) -> np.ndarray:
        x = v.reshape(-1, 3)
        y = np.empty_like(x)
        kernels.product(*self.couplings.pattern, self.off, self.diagonal, self.order, x, y)
        return np.ldexp(y.ravel(), self.exponent) if self.exponent else y.ravel()

    def _slotted(self, v: np.ndarray) -> np.ndarray:
        """v (3 k,) by slots, (k, 4) in the precision of the matrix: the fourth is 0."""
        x = np.zeros((self.order.size, 4), self.off.dtype)
        x[self.order, :3] = v.reshape(-1, 3)
        return x

    def solve(self, right: np.ndarray, tolerance: float, iterations: int, damping: float = 0.0) -> CGResult:
        """Solution by conjugate gradients, preconditioned by symmetric Gauss-Seidel.

        What has been reached before a direction of negative curvature is returned, or, if it is the first, that
        direction: one of descent for right = -gradient either way. It is 0 for a right-hand side that is not finite.
        Numbers of the solution that leave the range of float64 are infinite.

        The right-hand side is scaled by a power of two so that its largest number lies between 1/2 and 1: squares of
        very small or very large ones would leave the range of single precision.

        Parameters
        ----------
        right : (3 k,) float64
        tolerance : float
            Of the residual, relative to the right-hand side, both in the norm of the preconditioner.
        iterations : int
            Limit, after which the solution so far is taken as it is.
        damping : float
            The diagonal blocks, made positive definite, are added this many times.

        Raises
        ------
        MeshError
            For a right-hand side of another shape or type.
        """
        right = self._vector(right, "the right-hand side")
        size = float(np.abs(right).max(initial=0.0))
        if size == 0 or not np.isfinite(size):
            return CGResult(np.zeros(right.size), 0, False)
        exponent = int(np.frexp(size)[1])
        b = self._slotted(np.ldexp(right, -exponent))  # scaled by a power of two, x keeps its bits
        x = np.empty_like(b)
        count, end = kernels.solve(
            *self.couplings.pattern, self.off, self.diagonal, damping, b, tolerance, iterations, x, self._work
        )
        with np.errstate(over="ignore"):
            solution = np.ldexp(x[self.order, :3].astype(np.float64).ravel(), exponent - self.exponent)
        return CGResult(solution, count, end == kernels.NEGATIVE_CURVATURE)

    @property
    def diagonal_blocks(self) -> np.ndarray:
        """The 3 x 3 blocks that couple a node with itself, (k, 6): xx xy xz yy yz zz."""
        return np.ldexp(self.diagonal[self.order].astype(np.float64), self.exponent)

    def matrix(self) -> csr_array:
        """The same as a sparse matrix of SciPy's, (3 k, 3 k), some 243 entries a free node."""
        from scipy.sparse import coo_array

        _, start, columns = self.couplings.pattern
        slots = np.arange(self.order.size)
        rows, off = np.repeat(slots, np.diff(start)), self.off[:-1].reshape(-1, 3, 3)
        i, j = np.concatenate([slots, rows, columns]), np.concatenate([slots, columns, rows])
        blocks = np.concatenate([unpack_symmetric(self.diagonal), off, off.transpose(0, 2, 1)])
        free = np.argsort(self.order)  # the number of each slot's node among the free nodes
        row = 3 * free[i][:, None, None] + np.arange(3)[:, None]
        column = 3 * free[j][:, None, None] + np.arange(3)
        row, column = np.broadcast_arrays(row, column)
        blocks = np.ldexp(blocks.astype(np.float64), self.exponent)
        return coo_array((blocks.ravel(), (row.ravel(), column.ravel())), shape=self.shape).tocsr()


def unpack_symmetric(blocks: np.ndarray) -> np.ndarray:
    """Symmetric blocks (k, 6) as matrices (k, 3, 3)."""
    return blocks[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)
