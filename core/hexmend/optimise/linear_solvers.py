"""Linear solvers for H p = -g with a symmetric H.

Minimum residuals (Paige and Saunders 1975), ended by the residual relative to the right-hand side.

Limit of BLAS to one thread while SciPy's solvers work, which leaves the cores to the kernels.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Protocol

import numpy as np

from hexmend.arrays import dot, euclidean_norm
from hexmend.energy import Hessian

Vector = np.ndarray


class LinearSolver(Protocol):
    """Function that solves H x = b."""

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        """Solve for a right-hand side (3 k,); returns the solution (3 k,) and the number of iterations."""


@dataclass(frozen=True)
class Minres:
    """Minimum residuals without a preconditioner, as in the thesis (4.1.2); takes indefinite matrices.

    Parameters
    ----------
    tolerance : float
        Of the residual, relative to the right-hand side.
    iterations : int
        Limit, after which the solution so far is returned.
    """

    tolerance: float = 1e-6
    iterations: int = 1000

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        matrix = hessian.assembled(np.float64)
        with one_blas_thread():
            return minres(matrix.matvec, right, self.tolerance, self.iterations)


@dataclass(frozen=True)
class ConjugateGradients:
    """Conjugate gradients with symmetric Gauss-Seidel, ended at a direction of negative curvature (Steihaug 1983).

    Parameters
    ----------
    tolerance : float
        Of the residual, relative to the right-hand side, both in the norm of the preconditioner.
    iterations : int
        See `Minres`.
    precision : type
        Of matrix and vectors: single precision is twice as fast and accurate enough for a direction.
    """

    tolerance: float = 1e-6
    iterations: int = 1000
    precision: type = np.float32

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        solved = hessian.assembled(self.precision).solve(right, self.tolerance, self.iterations)
        return solved.x, solved.iterations


def minres(
    product: Callable[[np.ndarray], np.ndarray], right: np.ndarray, tolerance: float, iterations: int
) -> tuple[np.ndarray, int]:
    """Solve A x = b with a symmetric A, which may be indefinite, from x = 0.

    It ends at |b - A x| <= tolerance |b|, as MATLAB's (4.1.2). SciPy's rule compares with |A| |x|: with an
    ill-conditioned matrix it ends much sooner, with a poor direction.

    Parameters
    ----------
    product : callable
        v (n,) -> A v (n,).
    right : (n,) float64
        b.
    tolerance : float
    iterations : int
        Limit, after which the solution so far is returned, as it is where A or b overflow: none in the Krylov space
        has a smaller residual.

    Returns
    -------
    x : (n,) float64
    iterations : int

    Examples
    --------
    >>> matrix = np.diag([3.0, -2.0, 0.5])
    >>> x, count = minres(matrix.__matmul__, np.array([3.0, 2.0, 1.0]), 1e-10, 100)
    >>> x.round(8).tolist(), count
    ([1.0, -1.0, 2.0], 3)
    """
    x, residual = np.zeros(right.size), euclidean_norm(right)
    beta, goal = residual, tolerance * residual
    if residual == 0 or not np.isfinite(residual):
        return x, 0
    last, now = np.zeros(right.size), right / beta  # Lanczos's vectors
    before, direction = np.zeros(right.size), np.zeros(right.size)  # columns of V R^-1
    below = off_diagonal = epsilon = 0.0
    c, s = -1.0, 0.0  # the last Givens rotation
    for count in range(1, iterations + 1):
        # Lanczos: A now = below last + alpha now + beta next.
        following = product(now)
        if count > 1:
            following -= below * last
        alpha = dot(now, following)
        following -= alpha * now
        beta = euclidean_norm(following)
        if not np.isfinite(beta):  # overflow: no later iterate is finite
            return x, count
        # A column of the tridiagonal matrix becomes one of R = Q T.
        upper, delta, gamma = epsilon, c * off_diagonal + s * alpha, s * off_diagonal - c * alpha
        epsilon, off_diagonal = s * beta, -c * beta
        length = float(np.hypot(gamma, beta)) or np.finfo(float).tiny
        c, s = gamma / length, beta / length
        before, direction = direction, (now - upper * before - delta * direction) / length
        x += c * residual * direction
        residual *= s
        if residual <= goal or beta == 0:
            return x, count
        last, now, below = now, following / beta, beta
    return x, iterations


if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController


@cache
def _libraries() -> ThreadpoolController:
    import scipy.linalg  # noqa: F401  (loads a BLAS of its own, which threadpoolctl finds only then)
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def one_blas_thread() -> AbstractContextManager[object]:
    """Context in which BLAS uses one thread.

    BLAS splits vectors of 10,000 numbers already, and its threads wait by spinning: on two busy cores its product of
    two vectors of 90,000 numbers takes longer than a gradient. Its sums also depend on the number of threads.
    """
    return _libraries().limit(limits=1, user_api="blas")
