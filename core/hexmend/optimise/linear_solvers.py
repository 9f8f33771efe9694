"""Linear solvers for H p = -g with a symmetric H.

Limit of BLAS to one thread while SciPy's solvers work, which leaves the cores to the kernels.
"""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Protocol

import numpy as np

from hexmend.energy import Hessian
from hexmend.optimise.minres import minres

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
